#include "firmtouch/hal/link.hpp"

#include "emulator/file_link.hpp"
#include "parts/byte_ring.hpp"
#include "registers.hpp"

// A UART at 1 Mbaud, which the ST-LINK of a Nucleo shows as a serial port; or two FIFOs on the
// machine that runs the emulator (file_link.hpp).
namespace firmtouch::hal {
namespace {

ByteRing g_received;

}  // namespace

void link_begin() {
  if (file_link_begin()) return;
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
  if (file_link_is_open()) return file_link_write(from, count);
  uint32_t sent = 0;
  while (sent < count && (reg(kLink + kUsartState) & kTransmitEmpty) != 0)
    reg(kLink + kUsartSent) = from[sent++];
  return sent;
}

// Over the UART it returns at once: the main loop also polls the enable switch, which raises no
// interrupt. (During WFI an emulator's virtual time jumps over ticks and watchdog time-outs.)
void link_wait() {
  if (file_link_is_open()) file_link_wait(g_received);
}

}  // namespace firmtouch::hal
