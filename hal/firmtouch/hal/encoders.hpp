#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Latches the three joint encoders at one instant and reads their counts.
/// Result: false if a count is invalid (index lost, CRC error). The tick then carries
/// record::kFlagEncoderFault, and the controller ignores the counts.
/// Context: servo interrupt.
bool encoders_read(int32_t (&counts)[3]);

/// Low bytes of the counts of the joints' second encoders, latched by the last encoders_read() at
/// the same instant; of an invalid one that returned false. Only programs with part
/// `second_encoders` call it. Context: servo interrupt.
void encoders_second(uint8_t (&counts)[3]);

/// Index pulses from the encoders_read() before the last one to the last one. Result: bit k: joint
/// k passed one; `counts`: the low byte of its count there, latched by the board's timer at the
/// pulse, whichever way the joint moved. Only programs with part `index_pulses` call it, once a
/// tick.
/// Context: servo interrupt.
uint32_t encoders_index(uint8_t (&counts)[3]);

}  // namespace firmtouch::hal
