#pragma once
#include "cortex-m/cortex_m.hpp"
#include "registers.hpp"  // the board's: clock rates, addresses, interrupt numbers

// Arm's CMSDK peripherals (DDI 0479), as on the boards MPS2 and MPS3. A board lists its addresses
// in its `registers.hpp`, and defines its vectors and the functions below.
namespace firmtouch::hal {

constexpr uint32_t kUartData = 0x0, kUartState = 0x4, kUartControl = 0x8, kUartInterrupt = 0xC,
                   kUartDivider = 0x10;
constexpr uint32_t kTransmitFull = 1u << 0, kReceiveFull = 1u << 1;  // of state
constexpr uint32_t kTransmitOn = 1u << 0, kReceiveOn = 1u << 1,
                   kReceiveInterrupt = 1u << 3;  // of control

void clock_begin();
void link_begin();

/// Starts the counter behind clock_work(), which counts kCore_MHz. Defined by the board.
void work_counter_begin();
/// Ticks of the watchdog in `timeout_us`. Defined by the board.
uint32_t watchdog_ticks(uint32_t timeout_us);

}  // namespace firmtouch::hal
