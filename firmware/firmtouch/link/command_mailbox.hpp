#pragma once
#include <stdint.h>

#include "firmtouch/record/ring.hpp"
#include "firmtouch/record/tick.hpp"

namespace firmtouch::link {

/// Queue of commands (set a parameter, clear faults) from the main loop to the tick. A tick takes
/// at most one, at its beginning, so that its record shows which command changed what.
class CommandMailbox {
 public:
  static constexpr uint32_t kCapacity = 8;  // a burst of sliders; a ninth gets kAckBusy

  /// Main loop: queues a new value of a parameter.
  /// Bounds: wait-free.
  /// Result: false if the mailbox is full.
  bool put(uint32_t parameter_index, float value) {
    return ring_.push({parameter_index + 1, value});
  }

  /// Main loop: queues the command that clears the latched faults.
  /// Bounds: wait-free.
  /// Result: false if the mailbox is full.
  bool put_clear_faults() { return ring_.push({record::kCommandClearFaults, 0}); }

  /// Main loop: queues the command that begins to touch the next asset.
  /// Bounds: wait-free.
  /// Result: false if the mailbox is full.
  bool put_swap() { return ring_.push({record::kCommandSwapAsset, 0}); }

  /// Main loop: a command waits for its tick.
  bool has_waiting() const { return ring_.waiting() > 0; }

  /// Servo interrupt: moves the oldest command into `input`; kCommandNone if there is none.
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
  record::Ring<Command, kCapacity, 4> ring_;  // 4: both sides share a core
};

}  // namespace firmtouch::link
