#include "firmtouch/hal/link.hpp"

#include "emulator/file_link.hpp"
#include "parts/byte_ring.hpp"
#include "registers.hpp"

// A UART at 1 Mbaud, which a debugger or an adapter shows as a serial port; or two FIFOs on the
// machine that runs the emulator (file_link.hpp). The vectors behind the core's are this one's.
namespace firmtouch::hal {

extern "C" void link_handler();

namespace {

ByteRing g_received;

[[gnu::section(".vectors.board"), gnu::used]] const BoardVectors<kLinkInterrupt> kBoardVectors = {
    {}, link_handler};

}  // namespace

void link_begin() {
  if (file_link_begin()) return;
  uart_begin(kLink, 1000000, true);
  enable_interrupt(kLinkInterrupt, kReceivePriority);
}

extern "C" void link_handler() {
  while (uart_has_byte(kLink)) g_received.push(uart_byte(kLink));
}

uint32_t link_read(uint8_t* to, uint32_t capacity) { return g_received.pop(to, capacity); }

uint32_t link_write(const uint8_t* from, uint32_t count) {
  if (file_link_is_open()) return file_link_write(from, count);
  uint32_t sent = 0;
  while (sent < count && uart_may_send(kLink)) uart_send(kLink, from[sent++]);
  return sent;
}

// Over the UART it returns at once: the main loop also polls the enable switch, which raises no
// interrupt. (During WFI an emulator's virtual time jumps over ticks and watchdog time-outs.)
void link_wait() {
  if (file_link_is_open()) file_link_wait(g_received);
}

}  // namespace firmtouch::hal
