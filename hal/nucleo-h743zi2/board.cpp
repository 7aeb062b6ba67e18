#include "cortex-m/caches.hpp"
#include "registers.hpp"

namespace firmtouch::hal {
#ifdef FIRMTOUCH_QSPI_ASSET
void qspi_begin();
#else
inline void qspi_begin() {}  // the asset is in the second bank
#endif
namespace {

constexpr uint32_t kRccControl = kRcc + 0x00, kPllOn = 1u << 24, kPllReady = 1u << 25;
constexpr uint32_t kRccClock = kRcc + 0x10;     // b0-2 switch, b3-5 its state
constexpr uint32_t kRccDividers = kRcc + 0x18;  // of the three domains
constexpr uint32_t kRccPllSource = kRcc + 0x28, kRccPll = kRcc + 0x2C,
                   kRccPllDividers = kRcc + 0x30;
constexpr uint32_t kSupplyState = 0x58024804, kSupply = 0x5802480C, kRange = 0x58024818;
constexpr uint32_t kReady = 1u << 13;  // of supply state and range
constexpr uint32_t kFlash = 0x52002000;

// 64 MHz / 8 * 100 / 2 = 400 MHz for the core, 200 MHz for buses and timers, 100 MHz for UARTs.
void pll_begin() {
  reg(kRccDividers + 0) = 8u | 4u << 4;
  reg(kRccDividers + 4) = 4u << 4 | 4u << 8;
  reg(kRccDividers + 8) = 4u << 4;
  reg(kRccPllSource) = 8u << 4;  // the internal oscillator
  reg(kRccPll) = 3u << 2 | 1u << 16;
  reg(kRccPllDividers) = 99u | 1u << 9 | 1u << 16 | 1u << 24;
  reg(kRccControl) = reg(kRccControl) | kPllOn;
  while ((reg(kRccControl) & kPllReady) == 0) {
  }
  reg(kRccClock) = 3;
  while ((reg(kRccClock) & 7u << 3) != 3u << 3) {
  }
}

}  // namespace

// Supply, highest range, flash, then the clock (RM0433, 6.8.4 and 8.5.5).
void power_begin() {
  reg(kSupply) = (reg(kSupply) & ~7u) | 1u << 1;  // the linear regulator, as the board is wired
  while ((reg(kSupplyState) & kReady) == 0) {
  }
  reg(kRange) = 3u << 14;
  while ((reg(kRange) & kReady) == 0) {
  }
  reg(kFlash) = 2u | 2u << 4;
  while ((reg(kFlash) & 0xFu) != 2u) {
  }
  if ((reg(kRccClock) & 7u << 3) != 3u << 3) pll_begin();
  qspi_begin();
  caches_begin();
}

}  // namespace firmtouch::hal
