#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"

// Frame of every message between controller and host, little-endian:
//
//     offset 0  sync      u16  kSync
//            2  sequence  u16  the sender's count; a reply has the count of its request
//            4  length    u16  of the payload, 0 to kMaxPayloadBytes
//            6  type      u8   link::Type
//            7  check     u8   low byte of the CRC-32 of bytes 0 to 6: detects a damaged length
//                              before the decoder waits for that many bytes
//            8  payload
//     8+length  crc       u32  CRC-32 of everything before it
namespace firmtouch::link {

constexpr uint16_t kSync = 0x5AF7;
constexpr uint32_t kHeaderBytes = 8, kCrcBytes = 4;
// One record a frame, with a reserve; also the decoder's buffer.
constexpr uint32_t kMaxFrameBytes = 256;
constexpr uint32_t kMaxPayloadBytes = kMaxFrameBytes - kHeaderBytes - kCrcBytes;

struct Frame {
  uint8_t type = 0;
  uint16_t sequence = 0;
  core::Bytes payload;
};

/// Encodes one frame into `to`.
/// Bounds: one pass over the payload; re-entrant; interrupt-safe.
/// Result: bytes written; 0 if the payload exceeds kMaxPayloadBytes or the frame exceeds `to`.
uint32_t encode(uint8_t type, uint16_t sequence, core::Bytes payload, core::Span<uint8_t> to);

/// The bytes of a plain payload struct.
template <class T>
core::Bytes bytes_of(const T& value) {
  static_assert(__is_trivially_copyable(T),
                "a payload is a plain struct (without padding: assert its size)");
  return {reinterpret_cast<const uint8_t*>(&value), sizeof(T)};
}

/// Copies a frame's payload into `value`.
/// Result: false, and `value` unchanged, if the length is not sizeof(T).
template <class T>
bool take(const Frame& frame, T& value) {
  static_assert(__is_trivially_copyable(T), "a payload is a plain struct");
  if (frame.payload.size() != sizeof(T)) return false;
  __builtin_memcpy(&value, frame.payload.data(), sizeof(T));
  return true;
}

}  // namespace firmtouch::link
