#pragma once
#include <stdint.h>

#include "firmtouch/params/saved.hpp"
#include "firmtouch/record/tick.hpp"

namespace firmtouch::app {

/// Erases what the next save needs. Start-up: it may stop the processor for seconds.
void prepare_saving();

/// Writes the present parameters to flash. Main loop.
/// Result: Ack::result of the link.
uint32_t save_parameters();

/// Saved parameters as commands of the first ticks, so that a replay of the record sets them too.
class SavedCommands {
 public:
  /// Main loop, before the servo starts.
  void begin();
  /// Servo interrupt: puts the next row into `input`. Result: false if none is left.
  bool take(record::TickInput& input);

 private:
  const params::Saved* saved_ = nullptr;
  bool is_same_table_ = false;
  uint32_t row_ = 0;
};

}  // namespace firmtouch::app
