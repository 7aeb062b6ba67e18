#include <cmath>
#include <deque>
#include <functional>

#include "bench/all_benches.hpp"
#include "firmtouch/device/velocity.hpp"

// Errors of velocity estimators on the counts of an encoder of 30 um, from rest at 0.5 s: a steady
// 5 mm/s, slower and faster steady motions, and a sine of 10 Hz that peaks at 126 mm/s, the latter
// from 64 phases of the sampling. The firmware's estimators (firmtouch/device/velocity.hpp), and
// two windows that lost against them: a fixed one of five samples, and the longest that a straight
// line within a count fits (Janabi-Sharifi, Hayward & Chen 2000, end fit, at most 16 samples).
// `firmtouch-sim z-width --estimators` prints the stiffness that each allows.
namespace firmtouch::bench {
namespace {

constexpr double kQuantum_m = 30e-6;
constexpr double kPi = 3.14159265358979323846;

// Metres per second from this tick's count.
using Estimate = std::function<double(int32_t count)>;

Estimate of_firmware(device::Estimator kind, double period_s) {
  struct Axis {
    device::VelocityState state;
    int32_t count = 0;
    bool is_first = true;
  };
  return [axis = Axis{}, kind, period_s](int32_t count) mutable {
    const int32_t step = axis.is_first ? 0 : count - axis.count;
    axis.is_first = false;
    axis.count = count;
    return static_cast<double>(
        device::estimate(axis.state, {kind, 150.0f}, static_cast<float>(1 / kQuantum_m),
                         static_cast<float>(step), static_cast<float>(period_s)));
  };
}

Estimate of_window(size_t samples, bool is_adaptive, double period_s) {
  return [=, counts = std::deque<int32_t>()](int32_t count) mutable {
    counts.push_front(count);
    if (counts.size() > samples + 1) counts.pop_back();
    double slope = 0, low = -HUGE_VAL, high = HUGE_VAL;  // counts a sample
    for (size_t n = 1; n < counts.size(); ++n) {
      const double moved = counts[0] - counts[n], length = static_cast<double>(n);
      if (is_adaptive && (moved / length < low || moved / length > high)) break;
      slope = moved / length;
      low = std::fmax(low, (moved - 1) / length);
      high = std::fmin(high, (moved + 1) / length);
    }
    return slope * kQuantum_m / period_s;
  };
}

using Motion = std::function<double(double time_s)>;

// Root mean square in mm/s, from 0.5 s to 3 s.
double rms_mm_per_s(Estimate estimate, double period_s, const Motion& position_m,
                    const Motion& velocity_mps) {
  double sum = 0;
  int n = 0;
  for (int i = 0; i * period_s < 3; ++i) {
    const double time_s = i * period_s;
    const double v = estimate(static_cast<int32_t>(std::floor(position_m(time_s) / kQuantum_m)));
    if (time_s < 0.5) continue;
    sum += (v - velocity_mps(time_s)) * (v - velocity_mps(time_s));
    ++n;
  }
  return std::sqrt(sum / n) * 1e3;
}

double uniform(const Estimate& estimate, double period_s, double mps) {
  return rms_mm_per_s(
      estimate, period_s, [=](double t) { return 1e-6 + mps * t; }, [=](double) { return mps; });
}

double sine(const Estimate& estimate, double period_s) {
  constexpr double kOmega = 2 * kPi * 10, kAmplitude_m = 2e-3;
  constexpr int kPhases = 64;
  double worst = 0;
  for (int k = 0; k < kPhases; ++k) {
    const double phase = 0.0983 * k;
    worst = std::fmax(
        worst, rms_mm_per_s(
                   estimate, period_s,
                   [=](double t) { return kAmplitude_m * std::sin(kOmega * t + phase); },
                   [=](double t) { return kAmplitude_m * kOmega * std::cos(kOmega * t + phase); }));
  }
  return worst;
}

struct Rate {
  const char* name;
  double period_s, slow_goal, sine_goal;  // mm/s
};

}  // namespace

void run_velocity(const Options&, Report& report) {
  for (const Rate& rate : {Rate{"1 kHz", 1e-3, 1, 9}, Rate{"10 kHz", 1e-4, 1.2, 7}}) {
    const double t = rate.period_s;
    const struct {
      const char* name;
      Estimate estimate;
    } estimators[] = {{"difference of two samples", of_firmware(device::Estimator::kDifference, t)},
                      {"low-pass, 150 Hz", of_firmware(device::Estimator::kLowPass, t)},
                      {"window of five samples", of_window(5, false, t)},
                      {"adaptive window", of_window(16, true, t)},
                      {"tracking", of_firmware(device::Estimator::kTracking, t)}};
    report.heading("Root mean square error of velocity in mm/s, 30 um, " + std::string(rate.name));
    std::vector<std::vector<std::string>> rows;
    for (const auto& one : estimators) {
      std::vector<std::string> row = {one.name};
      for (const double mps : {1e-3, 3e-3, 5e-3, 20e-3, 50e-3})
        row.push_back(number_text(uniform(one.estimate, t, mps)));
      row.push_back(number_text(sine(one.estimate, t)));
      rows.push_back(row);
    }
    report.table({"estimator", "1 mm/s", "3", "5", "20", "50", "sine, worst phase"}, rows);
    const Estimate tracking = of_firmware(device::Estimator::kTracking, t);
    report.bar("tracking at 5 mm/s", rate.name, uniform(tracking, t, 5e-3), "mm/s", rate.slow_goal);
    report.bar("tracking on 10 Hz, 126 mm/s", rate.name, sine(tracking, t), "mm/s", rate.sine_goal);
  }
}

}  // namespace firmtouch::bench
