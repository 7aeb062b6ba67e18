// Edges of an encoder and their time stamps, against the motion's closed form.
#include "bench/estimators.hpp"

#include <cmath>

#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using bench::EncoderSample;

namespace {

constexpr double kQuantum_m = 30e-6, kPeriod_s = 1e-3, kPi = 3.14159265358979323846;

}  // namespace

// A parabola that turns round: 0.1 m/s less 0.5 m/s^2, in parts of a tenth of a period.
TEST(EdgeStamps_OfAParabola_AreItsTimesWithinAStamp) {
  constexpr double kSpeed_mps = 0.1, kBrake_mps2 = 0.5, kParts = 10;
  const auto at_m = [](double t) { return t * (kSpeed_mps - 0.5 * kBrake_mps2 * t); };
  bench::StampedEncoder encoder(kQuantum_m, kPeriod_s, 0);
  int ups = 0, downs = 0, none = 0;
  for (int tick = 1; tick <= 500; ++tick) {
    const double now_s = tick * kPeriod_s;
    for (int part = 1; part <= 10; ++part)
      encoder.move(at_m(now_s - kPeriod_s * (1 - part / kParts)), kPeriod_s / kParts);
    const EncoderSample sample = encoder.take();
    if (!sample.has_edge) {
      ++none;
      continue;
    }
    ++(sample.edge_is_up ? ups : downs);
    const double edge_m = (sample.edge_is_up ? sample.count : sample.count + 1) * kQuantum_m;
    const double root = std::sqrt(std::fmax(0, kSpeed_mps * kSpeed_mps - 2 * kBrake_mps2 * edge_m));
    const double edge_s = (kSpeed_mps - (sample.edge_is_up ? root : -root)) / kBrake_mps2;
    CHECK_LE(std::fabs(now_s - sample.edge_age_s - edge_s), 0.6 * kPeriod_s / 127);
  }
  CHECK(ups >= 150 && downs >= 150 && none >= 3);
}

// Of 10 Hz and 126 mm/s, and of a slow even motion, after half a second.
TEST(EdgeEstimate_OnASine_ErrsLessThanTheTrackingLine) {
  const double omega = 2 * kPi * 10;
  const auto at_m = [&](double t) { return 2e-3 * std::sin(omega * t); };
  double edges2 = 0, tracking2 = 0;
  bench::StampedEncoder encoder(kQuantum_m, kPeriod_s, 0);
  auto edges = bench::edge_estimate(kQuantum_m, kPeriod_s);
  auto tracking =
      bench::firmware_estimate({device::Estimator::kTracking, 0}, kQuantum_m, kPeriod_s);
  for (int part = 1; part <= 30000; ++part) {
    const double t = part * kPeriod_s / 10;
    encoder.move(at_m(t), kPeriod_s / 10);
    if (part % 10 != 0) continue;
    const EncoderSample sample = encoder.take();
    const double truth_mps = 2e-3 * omega * std::cos(omega * t);
    const double by_edges = edges(sample) - truth_mps, by_line = tracking(sample) - truth_mps;
    if (t < 0.5) continue;
    edges2 += by_edges * by_edges;
    tracking2 += by_line * by_line;
  }
  CHECK_LE(edges2, tracking2);
}

TEST(EdgeEstimate_EvenMotion_ErrsByLessThanOnePercent) {
  for (const double mps : {-5e-3, 1e-3, 5e-3}) {
    bench::StampedEncoder encoder(kQuantum_m, kPeriod_s, 1e-5);
    auto edges = bench::edge_estimate(kQuantum_m, kPeriod_s);
    double v = 0;
    for (int tick = 1; tick <= 3000; ++tick) {
      encoder.move(1e-5 + mps * tick * kPeriod_s, kPeriod_s);
      v = edges(encoder.take());
    }
    CHECK_LE(std::fabs(v - mps), 0.01 * std::fabs(mps));  // stamps are rounded
  }
}
