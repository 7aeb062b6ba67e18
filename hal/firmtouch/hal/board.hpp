#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"

// The interface of a board: link-time functions, one definition per board (hal/<board>).
// Groups, one header each: board (this file), clock, encoders, motors, watchdog, link. A board
// whose program moves by itself for a demonstration also defines pace.
//
// The word after "Context:" says where the functions are called from:
//   start-up         before the servo interrupt runs
//   main loop        may be interrupted by every other context
//   lower interrupt  below the servo interrupt (local models at two rates); calls no HAL function
//   servo interrupt  once a tick; only the link's receive interrupt is more urgent
//   any              from all of these and from the fault handler
namespace firmtouch::hal {

/// Sets up clocks, pins and console; the motors are off afterwards.
/// Context: start-up, once, before every other function of the HAL except motors_off().
void board_begin();

/// Name of the board, as its folder. Context: any.
const char* board_name();

/// The baked asset in memory-mapped flash, 16-byte aligned, read in place.
/// Result: exactly the asset if it was linked into the image; else the whole slot that one may have
/// been flashed into (asset::stated_bytes() returns its length).
/// Context: start-up.
core::Bytes board_asset();

/// Prints text for a person: debug UART or semihosting. May block.
/// Context: start-up, main loop, fault handler; never the servo interrupt.
void board_print(const char* text);

/// Masks interrupts, switches the motors off and stops. In a build for an emulator `status` becomes
/// the exit code of its process; on hardware the watchdog, if it runs, resets the chip.
/// Context: any.
[[noreturn]] void board_exit(int status);

/// Whether a host may end the program (Bye with kByeExit): an emulator or a process, not hardware.
/// Context: main loop.
bool board_may_exit();

/// Most stack in use since start-up, interrupts included. 0 if the board does not paint its stack.
/// Context: main loop.
uint32_t board_stack_high_bytes();

}  // namespace firmtouch::hal
