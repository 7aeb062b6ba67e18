#include "firmtouch/hal/board.hpp"

#include "cortex-m/caches.hpp"
#include "firmtouch/hal/motors.hpp"
#include "registers.hpp"

namespace firmtouch::hal {
namespace {

constexpr uint32_t kCoreDivider = kClock + 0x10, kBusDividers = kClock + 0x14,
                   kBusSources = kClock + 0x18, kUartSource = kClock + 0x24, kBusy = kClock + 0x48,
                   kSleep = kClock + 0x54;
constexpr uint32_t kFromCrystal = 1u << 25;  // of bus dividers
constexpr uint32_t kSourceBusy = 1u << 5, kCoreBusy = 1u << 16, kBusBusy = 1u << 1;

void change(uint32_t address, uint32_t mask, uint32_t value, uint32_t busy) {
  reg(address) = (reg(address) & ~mask) | value;
  while ((reg(kBusy) & busy) != 0) {
  }
}

// 24 MHz * 88 / 2 / 2 = 528 MHz, what the supply after reset (1.15 V) allows; 132 MHz for the bus.
void clocks_begin() {
  change(kBusSources, 3u << 12, 1u << 12, 0);
  change(kBusDividers, 7u << 27, 0, 0);
  change(kBusDividers, kFromCrystal, kFromCrystal, kSourceBusy);
  reg(kPll) = 1u << 13 | 88u;
  while ((reg(kPll) & 1u << 31) == 0) {
  }
  change(kCoreDivider, 7u, 1u, kCoreBusy);
  change(kBusDividers, 7u << 10 | 3u << 8, 3u << 8, kBusBusy);
  change(kBusSources, 3u << 18, 3u << 18, 0);
  change(kBusDividers, kFromCrystal, 0, kSourceBusy);
  change(kUartSource, 0x7F, 1u << 6, 0);  // the crystal
  change(kSleep, 3, 0, 0);                // WFI stops no clock: SysTick goes on
}

// The core may fetch ahead from what looks like memory: nothing is connected above the flash
// (region 1 and 2; 0 guards the stack).
void forbid(uint32_t region, uint32_t base, uint32_t bytes_log2) {
  reg(kMpuRegion) = region;
  reg(kMpuBase) = base;
  reg(kMpuSize) = 1u << 28 | (bytes_log2 - 1) << 1 | 1u;
}

}  // namespace

void power_begin() {
  clocks_begin();
  forbid(1, 0x70000000, 28);
  forbid(2, 0x80000000, 30);
  caches_begin();
}

void board_begin() {
  motors_off();
  power_begin();
  switch_on(kGateCrossbar);
  pin_as(kConsolePin, 2);
  for (const Pin& pin : kLinkPins) pin_as(pin, 2, Pull::kUp);
  reg(kPads + 0x550) = 1;  // UART 6 receives from pad AD 3
  peripherals_begin();
}

// 24 MHz: 24 samples a bit at 1 Mbaud, 16 below.
void uart_begin(uint32_t uart, uint32_t baud, bool receives) {
  const uint32_t cycles = kCrystal_MHz * 1000000 / baud;
  const uint32_t samples = cycles <= 32 ? cycles : 16;
  switch_on(uart_gate(uart));
  reg(uart + kUartControl) = 0;
  reg(uart + kUartBaud) = (samples - 1) << 24 | (cycles + samples / 2) / samples;
  reg(uart + kUartQueues) = 1u << 3 | 1u << 7;  // four bytes each way
  reg(uart + kUartControl) = kUartTransmits | (receives ? 1u << 18 | 1u << 21 : 0);
}

}  // namespace firmtouch::hal
