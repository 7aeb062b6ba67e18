#include "firmtouch/hal/encoders.hpp"

#include "registers.hpp"
#include "rp2350/pio.hpp"

// Three state machines of PIO0 count all edges, one at most in ten cycles of the core (15 million a
// second), and show their count in a register. A change of both channels at once counts nothing.
namespace firmtouch::hal {
namespace {

constexpr uint32_t kDecrement = 16, kShow = 17, kSample = 19, kIncrement = 23, kLast = 25;

struct Program {
  uint16_t code[kLast + 1];
};

// Behind a table of 16: where to go for each pair of old and new pins, B A B A. Y holds the count.
constexpr Program make_program() {
  Program program{{}};
  constexpr uint32_t kPosition[4] = {0, 1, 3, 2};  // of B A within a period: A leads when it grows
  for (uint32_t i = 0; i < 16; ++i) {
    const uint32_t moved = (kPosition[i % 4] - kPosition[i / 4]) % 4;
    program.code[i] = pio_jump(moved == 1 ? kIncrement : moved == 3 ? kDecrement : kSample);
  }
  const uint16_t rest[] = {
      pio_jump(kShow, PioIf::kYNotZeroThenDecrement),  // to the next in any case
      pio_move(PioTo::kIsr, PioFrom::kY),              // kShow
      pio_show(0),
      pio_out(PioTo::kIsr, 2),  // kSample: the old pins, then the new ones
      pio_in(PioFrom::kPins, 2),
      pio_move(PioTo::kOsr, PioFrom::kIsr),
      pio_move(PioTo::kPc, PioFrom::kIsr),
      pio_move(PioTo::kY, PioFrom::kY, true),  // kIncrement: ~(~Y - 1)
      pio_jump(kLast, PioIf::kYNotZeroThenDecrement),
      pio_move(PioTo::kY, PioFrom::kY, true)};
  for (uint32_t i = 0; i < kLast - 15; ++i) program.code[16 + i] = rest[i];
  return program;
}
constexpr Program kProgram = make_program();

constexpr uint32_t kShowInRegister = 1u << 15, kOutToTheRight = 1u << 19;
constexpr uint32_t kAll = 7;

}  // namespace

void encoders_begin() {
  release(kResetPio0);
  pio_load(kPio0, kProgram.code);
  for (uint32_t i = 0; i < 3; ++i) {
    pin_as(kEncoderPins[2 * i], kPio0Function, kPullUp);
    pin_as(kEncoderPins[2 * i + 1], kPio0Function, kPullUp);
    const PioMachine machine = {kPio0, i};
    reg(machine.at(kPioShift)) = kShowInRegister | kOutToTheRight;
    reg(machine.at(kPioPins)) = kEncoderPins[2 * i].number << 15;
    pio_execute(machine, pio_set(PioTo::kY, 0));
    pio_execute(machine, pio_move(PioTo::kOsr, PioFrom::kPins));
    pio_start(machine, kLast, kShow, kShow, 0);
  }
}

// The three within 0.1 us of each other.
bool encoders_read(int32_t (&counts)[3]) {
  const CriticalSection alone;
  for (uint32_t i = 0; i < 3; ++i)
    counts[i] = static_cast<int32_t>(reg(kPio0 + kPioShown + 16 * i));
  return (reg(kPio0 + kPioEnabled) & kAll) == kAll;
}

}  // namespace firmtouch::hal
