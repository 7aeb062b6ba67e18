#include "host_sim/plant/delay_line.hpp"

#include <algorithm>
#include <cmath>

namespace firmtouch::host_sim {

void DelayLine::command(Vec motor, double more_s) {
  ++tick_, since_s_ = 0;
  const double part = part_ + more_s / period_s_, whole = std::floor(part);
  late_.push_back(
      {tick_ + samples_ + static_cast<uint64_t>(whole), (part - whole) * period_s_, motor});
}

Vec DelayLine::mean(double time_s) {
  Vec mean;
  double from = 0;  // share of the step
  while (!late_.empty() && late_.front().tick <= tick_) {
    const Late& next = late_.front();
    const double to =
        next.tick < tick_ ? 0 : std::clamp((next.after_s - since_s_) / time_s, 0.0, 1.0);
    if (!(to < 1)) break;
    if (to > from) mean = mean + motor_ * (to - from), from = to;
    motor_ = next.motor;
    late_.pop_front();
  }
  since_s_ += time_s;
  return from > 0 ? mean + motor_ * (1 - from) : motor_;
}

}  // namespace firmtouch::host_sim
