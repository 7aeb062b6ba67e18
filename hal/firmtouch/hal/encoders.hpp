#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Latches and reads the three joint encoders, all of the same instant. Called from the servo interrupt.
/// Result: false where a count is not to be trusted (index lost, CRC error): the tick is told, the counts are ignored.
bool encoders_read(int32_t (&counts)[3]);

}  // namespace firmtouch::hal
