#include "firmtouch/hal/link.hpp"

#include "cmsdk/cmsdk.hpp"
#include "emulator/file_link.hpp"
#include "parts/byte_ring.hpp"

// UART1 at 1 Mbaud, or two FIFOs on the machine that runs the emulator (file_link.hpp).

namespace firmtouch::hal {
namespace {

constexpr uint32_t kDivider = kUart_MHz;  // 1 Mbaud; at least 16 (DDI 0479, 4.3)

ByteRing g_received;

}  // namespace

void link_begin() {
  if (file_link_begin()) return;
  reg(kUart1 + kUartDivider) = kDivider;
  reg(kUart1 + kUartControl) = kTransmitOn | kReceiveOn | kReceiveInterrupt;
  enable_interrupt(kUart1Receive, kReceivePriority);
}

extern "C" void uart1_receive_handler() {
  reg(kUart1 + kUartInterrupt) = 2;
  while ((reg(kUart1 + kUartState) & kReceiveFull) != 0) {
    g_received.push(static_cast<uint8_t>(reg(kUart1 + kUartData)));
  }
}

uint32_t link_read(uint8_t* to, uint32_t capacity) { return g_received.pop(to, capacity); }

uint32_t link_write(const uint8_t* from, uint32_t count) {
  if (file_link_is_open()) return file_link_write(from, count);
  uint32_t sent = 0;
  while (sent < count && (reg(kUart1 + kUartState) & kTransmitFull) == 0) {
    reg(kUart1 + kUartData) = from[sent++];
  }
  return sent;
}

// Over the UART it returns at once: the main loop also polls the enable switch, which raises no
// interrupt. (During WFI an emulator's virtual time jumps over ticks and watchdog time-outs.)
void link_wait() {
  if (file_link_is_open()) file_link_wait(g_received);
}

}  // namespace firmtouch::hal
