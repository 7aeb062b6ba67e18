#include <cmath>

#include "bench/all_benches.hpp"
#include "bench/estimators.hpp"

// Errors of velocity estimators on the counts of an encoder of 30 um, from rest at 0.5 s: a steady
// 5 mm/s, slower and faster steady motions, and a sine of 10 Hz that peaks at 126 mm/s, the latter
// from 64 phases of the sampling. `firmtouch-sim z-width --estimators` prints the stiffness that
// each allows.
namespace firmtouch::bench {
namespace {

constexpr double kQuantum_m = 30e-6;
constexpr double kPi = 3.14159265358979323846;
constexpr double kStep_s = 1e-5;  // of the encoder, or a tenth of a period

using Motion = std::function<double(double time_s)>;

// Root mean square in mm/s, from 0.5 s to 3 s.
double rms_mm_per_s(VelocityEstimate estimate, double period_s, const Motion& position_m,
                    const Motion& velocity_mps) {
  const int steps = static_cast<int>(std::lround(period_s / std::min(kStep_s, period_s / 10)));
  StampedEncoder encoder(kQuantum_m, period_s, position_m(0));
  double sum = 0;
  int n = 0;
  for (int i = 0; i * period_s < 3; ++i) {
    const double time_s = i * period_s;
    for (int k = 1; k <= steps && i > 0; ++k)
      encoder.move(position_m(k == steps ? time_s : time_s - period_s + period_s * k / steps),
                   period_s / steps);
    const double v = estimate(encoder.take());
    if (time_s < 0.5) continue;
    sum += (v - velocity_mps(time_s)) * (v - velocity_mps(time_s));
    ++n;
  }
  return std::sqrt(sum / n) * 1e3;
}

double uniform(const VelocityEstimate& estimate, double period_s, double mps) {
  return rms_mm_per_s(
      estimate, period_s, [=](double t) { return 1e-6 + mps * t; }, [=](double) { return mps; });
}

double sine(const VelocityEstimate& estimate, double period_s) {
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
    report.heading("Root mean square error of velocity in mm/s, 30 um, " + std::string(rate.name));
    std::vector<std::vector<std::string>> rows;
    for (const NamedEstimate& one : all_estimates(kQuantum_m, t)) {
      std::vector<std::string> row = {one.name};
      for (const double mps : {1e-3, 3e-3, 5e-3, 20e-3, 50e-3})
        row.push_back(number_text(uniform(one.estimate, t, mps)));
      row.push_back(number_text(sine(one.estimate, t)));
      rows.push_back(row);
    }
    report.table({"estimator", "1 mm/s", "3", "5", "20", "50", "sine, worst phase"}, rows);
    const VelocityEstimate tracking =
        firmware_estimate({device::Estimator::kTracking, 0}, kQuantum_m, t);
    report.bar("tracking at 5 mm/s", rate.name, uniform(tracking, t, 5e-3), "mm/s", rate.slow_goal);
    report.bar("tracking on 10 Hz, 126 mm/s", rate.name, sine(tracking, t), "mm/s", rate.sine_goal);
  }
}

}  // namespace firmtouch::bench
