#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"
#include "firmtouch/link/frame.hpp"

namespace firmtouch::app {

/// Frames for the host, kept until the link has taken every byte. Main loop only.
class Outbox {
 public:
  /// Adds one frame.
  /// Result: false, nothing added, if it does not fit before a flush().
  bool send(uint8_t type, uint16_t sequence, core::Bytes payload);
  bool send_text(uint16_t sequence, const char* text);
  /// Writes as many bytes as the link takes at once.
  void flush();
  bool empty() const { return count_ == 0; }
  /// A frame of any size fits, and the reply to one more message.
  bool has_room_to_stream() const { return kBytes - count_ >= 2 * link::kMaxFrameBytes; }

 private:
  static constexpr uint32_t kBytes = 4 * link::kMaxFrameBytes;
  uint8_t bytes_[kBytes] = {};
  uint32_t count_ = 0;
};

}  // namespace firmtouch::app
