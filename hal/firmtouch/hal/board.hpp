#pragma once
#include <stdint.h>

#include "firmtouch/core/span.hpp"

// What a board provides. Link-time functions, one definition a board (hal/<board>), no virtual functions. The groups:
//   board (this file), clock, encoders, motors, watchdog, link, flash.
namespace firmtouch::hal {

/// Clocks, FPU, console: called first, once.
void board_begin();

/// Name of the board, as its folder.
const char* board_name();

/// Where the board keeps the baked asset (flash, memory-mapped flash): read in place, 16-byte aligned. Exactly the asset
/// where it was linked into the image; else the whole slot that one may have been flashed into (asset::stated_bytes()).
core::Bytes board_asset();

/// Text for a person: debug UART or semihosting. May block; never called from an interrupt.
void board_print(const char* text);

/// Stops. On an emulator the status becomes the process's exit code; on hardware the motors are off and it waits.
[[noreturn]] void board_exit(int status);

/// Most stack that was in use since start-up, interrupts included. 0 where the board does not paint its stack.
uint32_t board_stack_high_bytes();

}  // namespace firmtouch::hal
