#pragma once

namespace firmtouch::hal {

/// Ends the emulator's process with `status`. Returns if there is none, as on hardware.
/// Context: board_exit().
void emulator_exit(int status);

}  // namespace firmtouch::hal
