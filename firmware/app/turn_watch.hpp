#pragma once
#include <stdint.h>

namespace firmtouch::app {

/// Whether the main loop still makes progress, as the servo interrupt sees it. A main loop that
/// stands still answers no host and makes no model: its watchdog is no longer fed.
class TurnWatch {
 public:
  /// Main loop: once a turn.
  void count() {
    __atomic_store_n(&turns_, __atomic_load_n(&turns_, __ATOMIC_RELAXED) + 1, __ATOMIC_RELAXED);
  }

  /// Any context: a snapshot; wraps.
  uint32_t turns() const { return __atomic_load_n(&turns_, __ATOMIC_RELAXED); }

  /// Servo interrupt: once a tick.
  /// Result: false if the main loop has made no turn in more than `max_ticks` ticks.
  bool is_alive(uint32_t max_ticks) {
    const uint32_t turns = this->turns();
    if (turns != seen_turns_) {
      seen_turns_ = turns;
      ticks_ = 0;
    } else if (ticks_ <= max_ticks) {
      ++ticks_;
    }
    return ticks_ <= max_ticks;
  }

 private:
  uint32_t turns_ = 0;       // written by the main loop only
  uint32_t seen_turns_ = 0;  // these two by the interrupt only
  uint32_t ticks_ = 0;       // since the last turn
};

}  // namespace firmtouch::app
