#pragma once
#include <stdint.h>

#include "firmtouch/record/ring.hpp"
#include "firmtouch/record/tick.hpp"

namespace firmtouch::link {

/// Parameters and the operator's wish to clear faults on their way from the main loop to the tick: accepted there, taken one a tick at its
/// beginning, so that every tick sees a whole set of parameters and the record shows which tick
/// changed which.
class CommandMailbox {
 public:
  static constexpr uint32_t kCapacity = 8;  // a burst of sliders; the ninth is told to come again

  /// Main loop.
  /// Bounds: wait-free.
  /// Result: false where the mailbox is full.
  bool put(uint32_t parameter_index, float value) {
    return ring_.push({parameter_index + 1, value});
  }

  /// Main loop: the latched faults are to be forgotten.
  /// Bounds: wait-free.
  /// Result: false where the mailbox is full.
  bool put_clear_faults() { return ring_.push({record::kCommandClearFaults, 0}); }

  /// Servo interrupt: fills the command of this tick, 0 where there is none.
  /// Bounds: wait-free.
  void take(record::TickInput& input) {
    record::Numbered<Command> next[1];
    const bool any = ring_.pop(next) == 1;
    input.command = any ? next[0].value.command : 0;
    input.command_value = any ? next[0].value.value : 0;
  }

 private:
  struct Command {
    uint32_t command = 0;  // as TickInput::command
    float value = 0;
  };
  record::Ring<Command, kCapacity, 4> ring_;  // on a controller both sides share a core
};

}  // namespace firmtouch::link
