#pragma once
#include "rp2350/rp2350.hpp"

// The RP2350's programmable input and output (datasheet, chapter 11): four state machines a block,
// which share 32 instructions.
namespace firmtouch::hal {

enum class PioTo : uint32_t { kPins, kX, kY, kNull, kPinDirections, kPc, kIsr, kOsr };
using PioFrom = PioTo;
enum class PioIf : uint32_t { kAlways = 0, kYNotZeroThenDecrement = 4, kPin = 6 };

constexpr uint16_t pio_code(uint32_t kind, uint32_t middle, uint32_t low) {
  return static_cast<uint16_t>(kind << 13 | middle << 5 | low);
}
constexpr uint16_t pio_jump(uint32_t to, PioIf condition = PioIf::kAlways) {
  return pio_code(0, static_cast<uint32_t>(condition), to);
}
constexpr uint16_t pio_in(PioFrom from, uint32_t bits) {
  return pio_code(2, static_cast<uint32_t>(from), bits);
}
constexpr uint16_t pio_out(PioTo to, uint32_t bits) {
  return pio_code(3, static_cast<uint32_t>(to), bits);
}
constexpr uint16_t pio_wait_for_word() { return pio_code(4, 5, 0); }  // pull block
constexpr uint16_t pio_show(uint32_t entry) { return pio_code(4, 0, 0x18 | entry); }
constexpr uint16_t pio_move(PioTo to, PioFrom from, bool inverted = false) {
  return pio_code(5, static_cast<uint32_t>(to),
                  (inverted ? 1u << 3 : 0) | static_cast<uint32_t>(from));
}
constexpr uint16_t pio_set(PioTo to, uint32_t value) {
  return pio_code(7, static_cast<uint32_t>(to), value);
}

constexpr uint32_t kPioEnabled = 0x00, kPioSend = 0x10, kPioProgram = 0x48, kPioShown = 0x128;
// Of a state machine, every 0x18 bytes.
constexpr uint32_t kPioClock = 0xC8, kPioExecution = 0xCC, kPioShift = 0xD0, kPioAddress = 0xD4,
                   kPioExecute = 0xD8, kPioPins = 0xDC;

struct PioMachine {
  uint32_t block, number;
  uint32_t at(uint32_t offset) const { return block + offset + 0x18 * number; }
};

/// Executes one instruction now.
inline void pio_execute(const PioMachine& machine, uint16_t code) {
  reg(machine.at(kPioExecute)) = code;
}
template <uint32_t N>
void pio_load(uint32_t block, const uint16_t (&program)[N]) {
  static_assert(N <= 32, "instructions of a block");
  for (uint32_t i = 0; i < N; ++i) reg(block + kPioProgram + 4 * i) = program[i];
}
/// Wraps from the last instruction to `wrap_to`; `start` in turn. `options` are the execution
/// register's further bits.
inline void pio_start(const PioMachine& machine, uint32_t last, uint32_t wrap_to, uint32_t start,
                      uint32_t options) {
  reg(machine.at(kPioClock)) = 1u << 16;  // every cycle of the core
  reg(machine.at(kPioExecution)) = last << 12 | wrap_to << 7 | options;
  pio_execute(machine, pio_jump(start));
  reg(machine.block + kPioEnabled + kSet) = 1u << machine.number;
}

}  // namespace firmtouch::hal
