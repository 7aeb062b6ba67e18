#pragma once
#include <deque>

#include "harness/test.hpp"
#include "registers.hpp"
#include "rp2350/pio.hpp"

// A state machine of the RP2350 after chapter 11 of its datasheet, for the instructions that the
// HAL uses. It reads what the HAL wrote to the registers, and shares no code with it.
struct StateMachine {
  uint32_t block, number;
  uint32_t y = 0, isr = 0, osr = 0, pc = 0, shown = 0, level = 0;
  std::deque<uint32_t> words;

  StateMachine(uint32_t in_block, uint32_t with_number) : block(in_block), number(with_number) {}

  uint32_t reg(uint32_t offset) const {
    return firmtouch::hal::registers[block + offset + 0x18 * number];
  }
  uint32_t in_base() const { return reg(0xDC) >> 15 & 31u; }
  uint32_t set_base() const { return reg(0xDC) >> 5 & 31u; }

  void execute(uint32_t code, uint32_t pins) {
    const uint32_t kind = code >> 13, middle = code >> 5 & 7u, low = code & 31u;
    const uint32_t seen = pins >> in_base() | pins << (32 - in_base()) % 32;
    uint32_t next = pc == (reg(0xCC) >> 12 & 31u) ? reg(0xCC) >> 7 & 31u : (pc + 1) % 32;
    if (kind == 0) {
      bool jumps = middle == 0;
      if (middle == 4) jumps = y-- != 0;
      if (middle == 6) jumps = (pins >> (reg(0xCC) >> 24 & 31u) & 1u) != 0;
      if (jumps) next = low;
    } else if (kind == 2 && middle == 0) {
      CHECK_EQ(reg(0xD0) >> 18 & 1u, 0u);  // to the left
      isr = isr << low | (seen & ((1u << low) - 1));
    } else if (kind == 3 && middle == 6) {
      CHECK_EQ(reg(0xD0) >> 19 & 1u, 1u);  // to the right
      isr = osr & ((1u << low) - 1);
      osr >>= low;
    } else if (kind == 4 && (code & 0xFFu) == 0x18u) {
      CHECK_EQ(reg(0xD0) >> 14 & 3u, 2u);  // the receive queue is a register
      shown = isr;
    } else if (kind == 4 && (code & 0xFFu) == 0xA0u) {
      if (words.empty()) return;  // stalls
      osr = words.front();
      words.pop_front();
    } else if (kind == 5) {
      const uint32_t from = low & 7u;
      uint32_t value = from == 0 ? seen : from == 2 ? y : from == 6 ? isr : osr;
      if ((low >> 3) == 1) value = ~value;
      if (middle == 2) y = value;
      if (middle == 5) next = value & 31u;
      if (middle == 6) isr = value;
      if (middle == 7) osr = value;
    } else if (kind == 7 && middle == 0) {
      level = low & 1u;
    } else {
      CHECK_EQ(code, 0u);  // not used by the HAL
    }
    pc = next;
  }
  void step(uint32_t pins) { execute(firmtouch::hal::registers[block + 0x48 + 4 * pc], pins); }
};
