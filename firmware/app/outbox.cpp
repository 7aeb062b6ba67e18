#include "outbox.hpp"

#include "firmtouch/hal/link.hpp"
#include "firmtouch/link/protocol.hpp"

namespace firmtouch::app {

bool Outbox::send(uint8_t type, uint16_t sequence, core::Bytes payload) {
  const uint32_t added = link::encode(type, sequence, payload, {bytes_ + count_, kBytes - count_});
  count_ += added;
  return added != 0;
}

bool Outbox::send_text(uint16_t sequence, const char* text) {
  uint32_t length = 0;
  while (text[length] != 0 && length < link::kMaxPayloadBytes) ++length;
  return send(link::kText, sequence, {reinterpret_cast<const uint8_t*>(text), length});
}

void Outbox::flush() {
  if (count_ == 0) return;
  const uint32_t taken = hal::link_write(bytes_, count_);
  for (uint32_t i = taken; i < count_; ++i) bytes_[i - taken] = bytes_[i];
  count_ -= taken;
}

}  // namespace firmtouch::app
