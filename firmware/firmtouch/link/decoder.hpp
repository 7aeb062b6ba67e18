#pragma once
#include <stdint.h>

#include "firmtouch/link/frame.hpp"

namespace firmtouch::link {

/// Finds the frames in a stream of bytes that may begin anywhere and be damaged anywhere. After a
/// rejected frame the search goes on at its second byte, so a false sync never swallows the true
/// frame behind it.
///
///     decoder.push(byte);
///     while (decoder.next(frame)) handle(frame);
///
/// One context at a time; no allocation, no clock: a sender that was cut off is followed by
/// whatever it says next.
class Decoder {
 public:
  /// Takes one byte.
  /// Pre: next() has said false since the last push().
  /// Result: false, the byte dropped and counted, where the memory is full (Pre was not kept).
  bool push(uint8_t byte);

  /// The next whole frame among the bytes taken; valid until the next call of either function.
  /// Bounds: a clean stream: one CRC a frame. At worst kMaxFrameBytes / 2 candidates, each one CRC
  /// and one move of at most kMaxFrameBytes.
  /// Result: false where more bytes are needed.
  bool next(Frame& frame);

  uint32_t frames() const { return frames_; }
  /// Candidates that began with the sync and were none: damaged header, length out of range, wrong
  /// CRC.
  uint32_t rejects() const { return rejects_; }
  /// Bytes that belonged to no frame.
  uint32_t skipped_bytes() const { return skipped_bytes_; }

 private:
  enum class Look { kWhole, kShort, kNone };
  Look look(uint32_t& frame_bytes) const;
  void drop(uint32_t count);

  uint8_t bytes_[kMaxFrameBytes] = {};
  uint32_t count_ = 0;
  // Bytes of the frame that the last next() gave: dropped at the following call.
  uint32_t given_ = 0;
  uint32_t frames_ = 0;
  uint32_t rejects_ = 0;
  uint32_t skipped_bytes_ = 0;
};

}  // namespace firmtouch::link
