#include "firmtouch/hal/encoders.hpp"

#include "registers.hpp"

// Three decoders count all edges with 32 bits. The crossbar takes the pads to them.
namespace firmtouch::hal {
namespace {

constexpr uint32_t kEncoder_bytes = 0x4000;
constexpr uint32_t kControl = 0x0, kFilter = 0x2, kUpper = 0xE, kLowerHeld = 0x14;
constexpr uint32_t kFirstOutput = 66, kOutputs = 5;  // of the crossbar, of each decoder

constexpr Gate gate(uint32_t joint) { return {4, 12 + joint}; }

}  // namespace

void encoders_begin() {
  for (uint32_t i = 0; i < 3; ++i) {
    const uint32_t encoder = kEncoder1 + kEncoder_bytes * i;
    switch_on(gate(i));
    for (uint32_t phase = 0; phase < 2; ++phase)
      crossbar(kEncoderPins[2 * i + phase], kEncoderInputs[2 * i + phase],
               kFirstOutput + kOutputs * i + phase);
    reg16(encoder + kFilter) = 1u << 8 | 4u;  // four samples of four cycles of the bus
    reg16(encoder + kControl) = 1u << 11;     // count from 0
  }
}

// Reading the upper half holds the lower one. The three within 0.5 us of each other.
bool encoders_read(int32_t (&counts)[3]) {
  const CriticalSection alone;
  bool is_counting = true;
  for (uint32_t i = 0; i < 3; ++i) {
    const uint32_t encoder = kEncoder1 + kEncoder_bytes * i;
    is_counting &= is_on(gate(i));
    const uint32_t upper = reg16(encoder + kUpper);
    counts[i] = static_cast<int32_t>(upper << 16 | reg16(encoder + kLowerHeld));
  }
  return is_counting;
}

}  // namespace firmtouch::hal
