#include "firmtouch/hal/link.hpp"

#include "parts/byte_ring.hpp"
#include "registers.hpp"

namespace firmtouch::hal {
namespace {

ByteRing g_received;

}  // namespace

void link_begin() {
  reg(kLink + 0x10) = kCore_MHz;              // 1 Mbaud
  reg(kLink + 0x8) = 1u | 1u << 1 | 1u << 3;  // transmit, receive, interrupt
  enable_interrupt(kLinkInterrupt, kReceivePriority);
}
extern "C" void link_handler() {
  reg(kLink + 0xC) = 2;
  while ((reg(kLink + 0x4) & 2u) != 0) g_received.push(static_cast<uint8_t>(reg(kLink)));
}
uint32_t link_read(uint8_t* to, uint32_t capacity) { return g_received.pop(to, capacity); }
uint32_t link_write(const uint8_t* from, uint32_t count) {
  uint32_t sent = 0;
  while (sent < count && (reg(kLink + 0x4) & 1u) == 0) reg(kLink) = from[sent++];
  return sent;
}
void link_wait() {}

}  // namespace firmtouch::hal
