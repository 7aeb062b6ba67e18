#include "firmtouch/link/decoder.hpp"

#include "firmtouch/core/crc32.hpp"
#include "firmtouch/link/frame_bytes.hpp"

namespace firmtouch::link {
namespace {

constexpr uint8_t kSyncFirst = static_cast<uint8_t>(kSync & 0xFFu);
constexpr uint8_t kSyncSecond = static_cast<uint8_t>(kSync >> 8);

}  // namespace

bool Decoder::push(uint8_t byte) {
  drop(given_);
  given_ = 0;
  if (count_ == kMaxFrameBytes) {
    ++skipped_bytes_;
    return false;
  }
  bytes_[count_++] = byte;
  return true;
}

bool Decoder::next(Frame& frame) {
  drop(given_);
  given_ = 0;
  for (;;) {
    // To the next byte that may begin a frame.
    uint32_t start = 0;
    while (start < count_ && bytes_[start] != kSyncFirst) ++start;
    skipped_bytes_ += start;
    drop(start);

    uint32_t frame_bytes = 0;
    switch (look(frame_bytes)) {
      case Look::kShort:
        return false;
      case Look::kNone:
        if (count_ > 1 && bytes_[1] == kSyncSecond) ++rejects_;
        ++skipped_bytes_;
        drop(1);
        break;
      case Look::kWhole:
        ++frames_;
        given_ = frame_bytes;
        frame.sequence = get_u16(bytes_ + 2);
        frame.type = bytes_[6];
        frame.payload = {bytes_ + kHeaderBytes, frame_bytes - kHeaderBytes - kCrcBytes};
        return true;
    }
  }
}

// What stands at the first byte: a whole frame, something that may become one, or none. Never
// kShort with full memory.
Decoder::Look Decoder::look(uint32_t& frame_bytes) const {
  if (count_ > 0 && bytes_[0] != kSyncFirst) return Look::kNone;
  if (count_ > 1 && bytes_[1] != kSyncSecond) return Look::kNone;
  if (count_ < kHeaderBytes) return Look::kShort;
  if (bytes_[7] != header_check(bytes_)) return Look::kNone;
  const uint32_t payload_bytes = get_u16(bytes_ + 4);
  if (payload_bytes > kMaxPayloadBytes) return Look::kNone;
  const uint32_t body = kHeaderBytes + payload_bytes;
  if (count_ < body + kCrcBytes) return Look::kShort;
  if (core::crc32({bytes_, body}) != get_u32(bytes_ + body)) return Look::kNone;
  frame_bytes = body + kCrcBytes;
  return Look::kWhole;
}

void Decoder::drop(uint32_t count) {
  if (count == 0) return;
  for (uint32_t i = count; i < count_; ++i) bytes_[i - count] = bytes_[i];
  count_ -= count;
}

}  // namespace firmtouch::link
