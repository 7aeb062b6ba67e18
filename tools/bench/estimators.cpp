#include "bench/estimators.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

namespace firmtouch::bench {
namespace {

constexpr double kStamps = 127;  // in a period

// The tracking line, whose place is known at an edge. Chosen as the firmware's constants are, on
// errors at 1 and 10 kHz and on the stiffest wall at rest; a smaller lead is better on a sine.
class EdgeLine {
 public:
  EdgeLine(double quantum_m, double period_s) : quantum_m_(quantum_m), period_s_(period_s) {}
  double next(const EncoderSample& sample) {
    const double step = is_first_ ? 0 : static_cast<double>(sample.count - count_);
    is_first_ = false;
    count_ = sample.count;
    since_s_ += period_s_;
    lead_ *= kForget_s / (kForget_s + period_s_);
    double end = within_ + slope_ * period_s_ - step;
    if (sample.has_edge) {
      const double edge = sample.edge_is_up ? 0 : 1;  // in the count that followed
      correct(edge - (end - slope_ * sample.edge_age_s), since_s_ - sample.edge_age_s);
      since_s_ = sample.edge_age_s;
      end = edge + slope_ * sample.edge_age_s;
    }
    within_ = std::clamp(end, 0.0, 1.0);
    if (within_ < end || within_ > end) {
      correct(within_ - end, since_s_);
      if (!sample.has_edge) since_s_ = 0;
    }
    return (slope_ + lead_) * quantum_m_;
  }

 private:
  static constexpr double kShare = 0.8, kLeadShare = 0.6, kForget_s = 0.002, kMinSince_s = 0.7e-3;
  void correct(double miss, double since_s) {
    const double correction = kShare * miss / std::max(since_s, kMinSince_s);
    slope_ += correction;
    lead_ += kLeadShare * correction;
  }

  double quantum_m_, period_s_;
  bool is_first_ = true;
  int32_t count_ = 0;
  double within_ = 0.5, slope_ = 0, lead_ = 0;  // counts, counts a second
  double since_s_ = 0;                          // the last correction
};

}  // namespace

VelocityEstimate firmware_estimate(const device::VelocitySettings& settings, double quantum_m,
                                   double period_s) {
  struct Axis {
    device::VelocityState state;
    int32_t count = 0;
    bool is_first = true;
  };
  return [axis = Axis{}, settings, quantum_m, period_s](const EncoderSample& sample) mutable {
    if (axis.is_first) {
      axis.is_first = false;
      axis.count = sample.count;
      return 0.0;
    }
    const int32_t step = sample.count - axis.count;
    axis.count = sample.count;
    return static_cast<double>(
        device::estimate(axis.state, settings, static_cast<float>(1 / quantum_m),
                         static_cast<float>(step), static_cast<float>(period_s)));
  };
}

VelocityEstimate window_estimate(size_t samples, bool is_adaptive, double quantum_m,
                                 double period_s) {
  return [=, counts = std::deque<int32_t>()](const EncoderSample& sample) mutable {
    counts.push_front(sample.count);
    if (counts.size() > samples + 1) counts.pop_back();
    double slope = 0, low = -HUGE_VAL, high = HUGE_VAL;  // counts a sample
    for (size_t n = 1; n < counts.size(); ++n) {
      const double moved = counts[0] - counts[n], length = static_cast<double>(n);
      if (is_adaptive && (moved / length < low || moved / length > high)) break;
      slope = moved / length;
      low = std::fmax(low, (moved - 1) / length);
      high = std::fmin(high, (moved + 1) / length);
    }
    return slope * quantum_m / period_s;
  };
}

VelocityEstimate edge_estimate(double quantum_m, double period_s) {
  return [line = EdgeLine(quantum_m, period_s)](const EncoderSample& sample) mutable {
    return line.next(sample);
  };
}

std::vector<NamedEstimate> all_estimates(double quantum_m, double period_s) {
  using device::Estimator;
  const auto of_firmware = [&](Estimator kind) {
    return firmware_estimate({kind, 150}, quantum_m, period_s);
  };
  return {{"0 difference", of_firmware(Estimator::kDifference), false},
          {"1 low-pass, 150 Hz", of_firmware(Estimator::kLowPass), false},
          {"2 tracking", of_firmware(Estimator::kTracking), false},
          {"window of five samples", window_estimate(5, false, quantum_m, period_s), false},
          {"adaptive window", window_estimate(16, true, quantum_m, period_s), false},
          {"edge time stamps", edge_estimate(quantum_m, period_s), true}};
}

StampedEncoder::StampedEncoder(double quantum_m, double period_s, double start_m)
    : quantum_m_(quantum_m), period_s_(period_s), position_m_(start_m) {
  sample_.count = count_at(start_m);
}

int32_t StampedEncoder::count_at(double position_m) const {
  return static_cast<int32_t>(std::floor(position_m / quantum_m_));
}

void StampedEncoder::move(double position_m, double time_s) {
  since_edge_s_ += time_s;
  const int32_t count = count_at(position_m);
  if (count != sample_.count) {
    sample_.has_edge = true;
    sample_.edge_is_up = count > sample_.count;
    const double edge_m = (sample_.edge_is_up ? count : count + 1) * quantum_m_;
    since_edge_s_ = time_s * (position_m - edge_m) / (position_m - position_m_);
    sample_.count = count;
  }
  position_m_ = position_m;
}

EncoderSample StampedEncoder::take() {
  EncoderSample taken = sample_;
  const double stamp = std::floor(since_edge_s_ / period_s_ * kStamps);
  taken.edge_age_s = (std::min(stamp, kStamps - 1) + 0.5) / kStamps * period_s_;
  sample_.has_edge = false;
  return taken;
}

}  // namespace firmtouch::bench
