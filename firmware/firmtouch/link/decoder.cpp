#include "firmtouch/link/decoder.hpp"

#include "firmtouch/core/crc32.hpp"
#include "firmtouch/link/frame_bytes.hpp"

namespace firmtouch::link {
namespace {

constexpr uint8_t kSyncFirst = static_cast<uint8_t>(kSync & 0xFFu);
constexpr uint8_t kSyncSecond = static_cast<uint8_t>(kSync >> 8);

}  // namespace

bool Decoder::push(uint8_t byte) {
  drop(returned_);
  returned_ = 0;
  if (count_ == kMaxFrameBytes) {
    ++skipped_bytes_;
    return false;
  }
  bytes_[count_++] = byte;
  return true;
}

bool Decoder::next(Frame& frame) {
  drop(returned_);
  returned_ = 0;
  if (count_ < expected_) return false;
  for (;;) {
    // Skips to the next byte that may start a frame.
    uint32_t start = 0;
    while (start < count_ && bytes_[start] != kSyncFirst) ++start;
    skipped_bytes_ += start;
    drop(start);

    uint32_t frame_bytes = 0;
    expected_ = 0;
    switch (match(frame_bytes)) {
      case Match::kIncomplete:
        expected_ = frame_bytes;
        return false;
      case Match::kNone:
        if (count_ > 1 && bytes_[1] == kSyncSecond) ++rejects_;
        ++skipped_bytes_;
        drop(1);
        break;
      case Match::kComplete:
        ++frames_;
        returned_ = frame_bytes;
        frame.sequence = get_u16(bytes_ + 2);
        frame.type = bytes_[6];
        frame.payload = {bytes_ + kHeaderBytes, frame_bytes - kHeaderBytes - kCrcBytes};
        return true;
    }
  }
}

// Whether a frame starts at the first byte, and how long it is if its header is there. Never
// kIncomplete with a full buffer.
Decoder::Match Decoder::match(uint32_t& frame_bytes) const {
  if (count_ > 0 && bytes_[0] != kSyncFirst) return Match::kNone;
  if (count_ > 1 && bytes_[1] != kSyncSecond) return Match::kNone;
  if (count_ < kHeaderBytes) return Match::kIncomplete;
  if (bytes_[7] != header_check(bytes_)) return Match::kNone;
  const uint32_t payload_bytes = get_u16(bytes_ + 4);
  if (payload_bytes > kMaxPayloadBytes) return Match::kNone;
  const uint32_t body = kHeaderBytes + payload_bytes;
  frame_bytes = body + kCrcBytes;
  if (count_ < frame_bytes) return Match::kIncomplete;
  if (core::crc32({bytes_, body}) != get_u32(bytes_ + body)) return Match::kNone;
  return Match::kComplete;
}

void Decoder::drop(uint32_t count) {
  if (count == 0) return;
  for (uint32_t i = count; i < count_; ++i) bytes_[i - count] = bytes_[i];
  count_ -= count;
}

}  // namespace firmtouch::link
