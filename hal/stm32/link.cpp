#include "firmtouch/hal/link.hpp"

#include "parts/byte_ring.hpp"
#include "registers.hpp"

// A UART at 1 Mbaud, which the ST-LINK of a Nucleo shows as a serial port.
namespace firmtouch::hal {
namespace {

ByteRing g_received;

}  // namespace

void link_begin() {
  for (const Pin& pin : kLinkPins) pin_alternate(pin, Pull::kUp);
  reg(kLink + kUsartErrors) = kNoOverrun;  // a lost byte breaks a frame, no more
  reg(kLink + kUsartDivider) = kUsart_MHz;
  reg(kLink + kUsartControl) = kUsartOn | kTransmitOn | kReceiveOn | kReceiveInterrupt;
  enable_interrupt(kLinkInterrupt, kReceivePriority);
}

extern "C" void link_handler() {
  while ((reg(kLink + kUsartState) & kReceived) != 0)
    g_received.push(static_cast<uint8_t>(reg(kLink + kUsartReceived)));
}

uint32_t link_read(uint8_t* to, uint32_t capacity) { return g_received.pop(to, capacity); }

uint32_t link_write(const uint8_t* from, uint32_t count) {
  uint32_t sent = 0;
  while (sent < count && (reg(kLink + kUsartState) & kTransmitEmpty) != 0)
    reg(kLink + kUsartSent) = from[sent++];
  return sent;
}

// At once: the main loop also polls the enable switch, which raises no interrupt.
void link_wait() {}

}  // namespace firmtouch::hal
