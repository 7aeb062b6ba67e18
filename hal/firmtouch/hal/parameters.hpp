#pragma once
#include "firmtouch/core/span.hpp"

// Flash that keeps parameters without power: two sectors, read in place. params/saved.hpp says what
// is in them.
namespace firmtouch::hal {

struct ParameterFlash {
  core::Bytes sector[2];  // 32-byte aligned, of one size; empty: this board keeps no parameters
};

/// Context: start-up, main loop.
ParameterFlash board_parameters();

/// Erases a sector to 0xFF. May stop the processor for seconds.
/// Result: false on failure.
/// Context: start-up, before watchdog_begin().
bool board_erase_parameters(uint32_t sector);

/// Programs erased bytes. May stop the processor for less than a tick at a time.
/// Pre: `offset` and the size are multiples of 32.
/// Result: false on failure; the caller compares what it reads.
/// Context: main loop, motors off.
bool board_program_parameters(uint32_t sector, uint32_t offset, core::Bytes bytes);

}  // namespace firmtouch::hal
