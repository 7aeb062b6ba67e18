#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Latches the three joint encoders at one instant and reads their counts.
/// Result: false if a count is invalid (index lost, CRC error). The tick then carries
/// record::kFlagEncoderFault, and the controller ignores the counts.
/// Context: servo interrupt.
bool encoders_read(int32_t (&counts)[3]);

}  // namespace firmtouch::hal
