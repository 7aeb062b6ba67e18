#include <algorithm>
#include <cmath>

#include "host_sim/bench/benches.hpp"
#include "host_sim/bench/rig.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kAim_m = 0.004;  // of the hand below the surface: 1.14 N across it

Lines frictions(double at_rest, double sliding) {
  return {{"friction_static", bench::number_text(at_rest)},
          {"friction_dynamic", bench::number_text(sliding)}};
}

Lines operator+(Lines a, const Lines& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

// Along x over a plate, after a second of rest.
RigRun slide(const Rig& rig, double speed_mps, double way_m, const Lines& settings) {
  const double z_m = rig.radius_m - kAim_m, end_m = way_m / 2;
  return rig.run(plate(0.04), {-end_m, 0, 0.002 + rig.radius_m},
                 {Rig::hold_s(0.3), rig.to({-end_m, 0, z_m}, 0.05), Rig::hold_s(1),
                  rig.to({end_m, 0, z_m}, speed_mps)},
                 Contact::kProxy, settings);
}

// Ticks of the second half of a slide, without its end.
struct Window {
  Window(const RigRun& run, double speed_mps, double way_m)
      : begin(run.size() - ticks(0.5 * way_m / speed_mps)),
        end(run.size() - ticks(0.02 * way_m / speed_mps) - 1) {}
  static size_t ticks(double time_s) { return static_cast<size_t>(1000 * time_s); }
  size_t begin, end;
};

// Force along the plate over force across it, of which `expected` is the closed form in each tick.
template <class Expected>
double ratio_error(const RigRun& run, const Window& window, Expected expected) {
  double along_N = 0, expected_N = 0;
  for (size_t i = window.begin; i < window.end; ++i) {
    along_N += std::hypot(run[i].force_N.x, run[i].force_N.y);
    expected_N += run[i].force_N.z * expected(i);
  }
  return std::fabs(along_N / expected_N - 1);
}

void force_ratios(const Rig& rig, const std::string& of, bench::Report& report) {
  for (const double mu : {0.05, 0.2, 0.5, 1.0, 2.0}) {
    double worst = 0;
    for (const double speed_mps : {0.005, 0.02, 0.05, 0.1, 0.3}) {
      const double way_m = std::clamp(0.7 * speed_mps, 0.03, 0.07);
      const RigRun run = slide(rig, speed_mps, way_m, frictions(mu, mu));
      const double error = ratio_error(run, {run, speed_mps, way_m}, [&](size_t) { return mu; });
      worst = std::max(worst, error);
    }
    report.bar("force ratio of mu " + bench::number_text(mu) + ", 5 to 300 mm/s: error", of,
               100 * worst, "%", 0.5);
  }
}

// From static to dynamic as exp(-(v / v_s)^2); v is that of the proxy over 16 ms.
void stribeck(const Rig& rig, const std::string& of, bench::Report& report) {
  constexpr double kStatic = 0.4, kDynamic = 0.25, kSpeed_mps = 0.1, kWay_m = 0.07;
  for (const double speed_mps : {0.02, 0.04, 0.06, 0.09, 0.12}) {
    const RigRun run = slide(rig, speed_mps, kWay_m,
                             frictions(kStatic, kDynamic) + Lines{{"friction_speed", "0.1 m/s"}});
    const auto expected = [&](size_t i) {
      const double v = norm(run[i].proxy_m - run[i - 16].proxy_m) / 0.016 / kSpeed_mps;
      return kDynamic + (kStatic - kDynamic) * std::exp(-v * v);
    };
    const Window window(run, speed_mps, kWay_m);
    const double span_mps = 1000 * norm(run[window.end].proxy_m - run[window.begin].proxy_m) /
                            static_cast<double>(window.end - window.begin);
    report.bar("Stribeck at " + bench::number_text(1e3 * speed_mps) + " mm/s: ratio, error", of,
               100 * ratio_error(run, window, expected), "%", 1,
               "0.4 to 0.25, 100 mm/s; mean speed " + bench::number_text(1e3 * span_mps) + " mm/s");
  }
}

// Friction of a speed adds to Coulomb's; v is that of the proxy in each tick.
void viscous(const Rig& rig, const std::string& of, bench::Report& report) {
  constexpr double kWay_m = 0.07, kSpeed_mps = 0.1;
  for (const double mu : {0.0, 0.3}) {
    for (const double c : {0.5, 2.0, 8.0}) {
      const RigRun run =
          slide(rig, kSpeed_mps, kWay_m,
                frictions(mu, mu) + Lines{{"friction_viscous", with_unit(c, "N*s/m")},
                                          {"contact_damping", "0 N*s/m"}});
      const auto expected = [&](size_t i) {
        return mu + c * norm(run[i].proxy_m - run[i - 1].proxy_m) / 0.001 / run[i].force_N.z;
      };
      report.bar("viscous friction of " + bench::number_text(c) + " N s/m, mu " +
                     bench::number_text(mu) + ": force, error",
                 of, 100 * ratio_error(run, {run, kSpeed_mps, kWay_m}, expected), "%", 0.5);
    }
  }
}

// Pulled aside by less than friction holds.
void stick(const Rig& rig, const std::string& of, bench::Report& report) {
  const double z_m = rig.radius_m - kAim_m;
  const RigRun run = rig.run(plate(0.04), {-0.02, 0, 0.01 + rig.radius_m},
                             {Rig::hold_s(0.3), rig.to({-0.02, 0, z_m}, 0.05), Rig::hold_s(0.3),
                              rig.to({-0.0195, 0, z_m}, 0.01), Rig::hold_s(61)},
                             Contact::kProxy, frictions(0.6, 0.4));
  const size_t begin = run.size() - 60000;
  double crept_m = 0;
  for (size_t i = begin; i < run.size(); ++i)
    crept_m = std::max(crept_m, norm(run[i].proxy_m - run[begin].proxy_m));
  report.bar("stuck for 60 s: creep of the proxy", of, crept_m / 10e-6, "counts", 0);
}

// The hand's way from one slip to the next, which is the period times its speed, in the middle half
// of a run: near its ends the hand is slow, and little decides when a slip begins.
class Slips {
 public:
  explicit Slips(const std::vector<double>& hand_m) : hand_m_(hand_m) {}
  void add(size_t tick) {
    if (tick < hand_m_.size() / 4 || tick > hand_m_.size() * 3 / 4) return;
    if (count_++ == 0) first_ = tick;
    last_ = tick;
  }
  int count() const { return count_; }
  double mean_m() const { return (hand_m_[last_] - hand_m_[first_]) / std::max(count_ - 1, 1); }

 private:
  const std::vector<double>& hand_m_;
  size_t first_ = 0, last_ = 0;
  int count_ = 0;
};

// A mass between the spring and damper of a hand and a spring to a proxy, which sticks up to one
// force and slides with another. In double, in steps of a microsecond.
struct StickSlip {
  double mass_kg, viscous_N_s_per_m, hand_N_per_m, hand_N_s_per_m, contact_N_per_m, static_N,
      dynamic_N;

  // Of the hand's positions along x, a millisecond apart.
  Slips slips(const std::vector<double>& hand_m) const {
    constexpr int kSteps = 1000;
    constexpr double kStep_s = 1e-6;
    Slips slips(hand_m);
    double x_m = hand_m[0], v_mps = 0, proxy_m = x_m;
    bool is_stuck = true;
    for (size_t i = 0; i + 1 < hand_m.size(); ++i) {
      const double hand_mps = (hand_m[i + 1] - hand_m[i]) / (kSteps * kStep_s);
      for (int k = 0; k < kSteps; ++k) {
        const double at_m = hand_m[i] + hand_mps * k * kStep_s;
        if (is_stuck && contact_N_per_m * (x_m - proxy_m) > static_N) {
          is_stuck = false;
          slips.add(i);
        } else if (!is_stuck && v_mps <= 0) {
          is_stuck = true;
        }
        if (!is_stuck) proxy_m = x_m - dynamic_N / contact_N_per_m;
        v_mps += kStep_s / mass_kg *
                 (hand_N_per_m * (at_m - x_m) + hand_N_s_per_m * (hand_mps - v_mps) -
                  viscous_N_s_per_m * v_mps - contact_N_per_m * (x_m - proxy_m));
        x_m += kStep_s * v_mps;
      }
    }
    return slips;
  }
};

// Of the proxy after 50 ms at rest.
Slips slips_of(const RigRun& run, size_t begin, const std::vector<double>& hand_m) {
  Slips slips(hand_m);
  size_t at_rest = 0;
  for (size_t i = begin; i + 1 < run.size(); ++i) {
    const bool moves = norm(run[i + 1].proxy_m - run[i].proxy_m) > 1e-6;
    if (moves && at_rest >= 50) slips.add(i - begin);
    at_rest = moves ? 0 : at_rest + 1;
  }
  return slips;
}

void stick_slip(const Rig& rig, const std::string& of, bench::Report& report) {
  const double across_N = rig.series_N_per_m() * kAim_m;
  const StickSlip model{0.075,          0.5,           rig.grip_N_per_m, 4, rig.stiffness_N_per_m,
                        0.6 * across_N, 0.3 * across_N};
  for (const double speed_mps : {0.001, 0.002, 0.003}) {
    const RigRun run =
        slide(rig, speed_mps, 0.03, frictions(0.6, 0.3) + Lines{{"contact_damping", "0 N*s/m"}});
    const size_t begin = 1300;  // pressed and at rest
    std::vector<double> hand_m;
    for (size_t i = begin; i < run.size(); ++i) hand_m.push_back(run[i].hand_m.x);
    const Slips found = slips_of(run, begin, hand_m), exact = model.slips(hand_m);
    report.bar("stick-slip at " + bench::number_text(1e3 * speed_mps) + " mm/s: period, error", of,
               100 * std::fabs(found.mean_m() / exact.mean_m() - 1), "%", 2,
               std::to_string(found.count()) + " slips, of the hand's way " +
                   bench::number_text(1e3 * exact.mean_m()) + " mm each");
  }
}

}  // namespace

// Friction of the standard rig on a plate.
void run_friction_bench(const bench::Options& options, bench::Report& report) {
  const uint64_t seeds = options.is_long ? 10 : 2;
  for (uint64_t seed = 0; seed < seeds; ++seed) {
    const Rig rig(seed);
    const std::string of = seed == 0 ? "upright" : "seed " + std::to_string(seed);
    report.stage(of);
    force_ratios(rig, of, report);
    stribeck(rig, of, report);
    viscous(rig, of, report);
    stick(rig, of, report);
    stick_slip(rig, of, report);
  }
}

}  // namespace firmtouch::host_sim
