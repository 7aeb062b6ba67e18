#pragma once

namespace firmtouch::hal {

/// Slows an emulator down to real time: its virtual time otherwise runs as fast as it can, and a
/// person watches. May block.
/// Context: servo interrupt of the simulated hand (firmware/app), once a tick.
void pace_tick();

}  // namespace firmtouch::hal
