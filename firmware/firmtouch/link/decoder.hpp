#pragma once
#include <stdint.h>

#include "firmtouch/link/frame.hpp"

namespace firmtouch::link {

/// Finds frames in a byte stream that may start anywhere and be damaged anywhere. After a rejected
/// candidate the search continues at its second byte, so a false sync never hides a valid frame.
///
///     decoder.push(byte);
///     while (decoder.next(frame)) handle(frame);
///
/// Not re-entrant; no allocation; no clock, so no time-out: an incomplete frame ends when later
/// bytes reject it.
class Decoder {
 public:
  /// Appends one byte.
  /// Pre: next() has returned false since the last push().
  /// Result: false if the buffer is full (only if Pre was violated); the byte is dropped and
  /// counted.
  bool push(uint8_t byte);

  /// The next complete frame; valid until the next call of either function.
  /// Bounds: one CRC a frame and one of its header in an undamaged stream; in the worst case
  /// kMaxFrameBytes / 2 candidates with one CRC and one move of kMaxFrameBytes each. Result: false
  /// if more bytes are needed.
  bool next(Frame& frame);

  uint32_t frames() const { return frames_; }
  /// Candidates that began with the sync and were rejected: damaged header, length out of range,
  /// wrong CRC.
  uint32_t rejects() const { return rejects_; }
  /// Bytes outside frames.
  uint32_t skipped_bytes() const { return skipped_bytes_; }

 private:
  enum class Match { kComplete, kIncomplete, kNone };
  Match match(uint32_t& frame_bytes) const;
  void drop(uint32_t count);

  uint8_t bytes_[kMaxFrameBytes] = {};
  uint32_t count_ = 0;
  // Bytes of the frame that the last next() returned; dropped at the following call.
  uint32_t returned_ = 0;
  // Bytes of the frame that starts at the first byte, once its header is there; else 0.
  uint32_t expected_ = 0;
  uint32_t frames_ = 0;
  uint32_t rejects_ = 0;
  uint32_t skipped_bytes_ = 0;
};

}  // namespace firmtouch::link
