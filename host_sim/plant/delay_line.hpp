#pragma once
#include <cstdint>
#include <deque>

#include "host_sim/plant/vec.hpp"

namespace firmtouch::host_sim {

/// Delay from the computed forces to the motors', which may differ from tick to tick. Forces never
/// overtake those of the ticks before.
class DelayLine {
 public:
  /// `samples`: whole; `part`: of a sample more, 0 or above.
  DelayLine(uint32_t samples, double part, double period_s)
      : samples_(samples), part_(part), period_s_(period_s) {}
  /// The forces of a tick that begins now; they act `more_s` later than the others.
  void command(Vec motor, double more_s);
  /// The mean of the forces over the next `time_s`, so that their impulse is exact.
  Vec mean(double time_s);

 private:
  struct Late {
    uint64_t tick = 0;   // in which it acts,
    double after_s = 0;  // so long after its begin
    Vec motor;
  };
  uint32_t samples_;
  double part_, period_s_, since_s_ = 0;
  uint64_t tick_ = 0;
  std::deque<Late> late_;  // in order of ticks: the first holds up the others
  Vec motor_;
};

}  // namespace firmtouch::host_sim
