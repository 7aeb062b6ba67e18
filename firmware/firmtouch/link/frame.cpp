#include "firmtouch/link/frame.hpp"

#include "firmtouch/core/crc32.hpp"
#include "firmtouch/link/frame_bytes.hpp"

namespace firmtouch::link {

uint32_t encode(uint8_t type, uint16_t sequence, core::Bytes payload, core::Span<uint8_t> to) {
  if (payload.size() > kMaxPayloadBytes) return 0;
  const uint32_t body = kHeaderBytes + payload.size();
  if (to.size() < body + kCrcBytes) return 0;
  uint8_t* out = to.data();
  put_u16(out, kSync);
  put_u16(out + 2, sequence);
  put_u16(out + 4, static_cast<uint16_t>(payload.size()));
  out[6] = type;
  out[7] = header_check(out);
  for (uint32_t i = 0; i < payload.size(); ++i) out[kHeaderBytes + i] = payload[i];
  put_u32(out + body, core::crc32({out, body}));
  return body + kCrcBytes;
}

uint8_t header_check(const uint8_t* header) {
  return static_cast<uint8_t>(core::crc32({header, kHeaderBytes - 1}) & 0xFFu);
}

}  // namespace firmtouch::link
