#include <algorithm>
#include <cmath>

#include "host_sim/bench/benches.hpp"
#include "host_sim/bench/rig.hpp"
#include "surface/random.hpp"

namespace firmtouch::host_sim {
namespace {

// Work of the motors on the device.
std::vector<double> work_J(const RigRun& run, size_t begin, size_t end) {
  std::vector<double> sum_J = {0};
  for (size_t i = begin + 1; i < end; ++i)
    sum_J.push_back(sum_J.back() + dot(run[i - 1].motor_N, run[i].device_m - run[i - 1].device_m));
  return sum_J;
}

// The largest gain of the hand from one tick without contact to a later one: then no spring holds
// energy. Of the hand's own work, with the motion of the device.
double gain_J(const RigRun& run) {
  double most_J = run[0].taken_J, gain_J = 0;
  for (const RigTick& tick : run) {
    if (tick.depth_m > 0) continue;
    most_J = std::max(most_J, tick.taken_J);
    gain_J = std::max(gain_J, most_J - tick.taken_J);
  }
  return gain_J;
}

// Raised from 100 to 2,000 N/m while a hand presses 20 mm deep: from 2 s on, and before the hand
// leaves.
void raise_under_load(const Rig& rig, const std::string& of, Contact contact,
                      bench::Report& report) {
  const double r = rig.radius_m, aim_m = 0.003;
  const Vec away_m{0.0123, 0.0071, 0.006 + r}, deep_m{0.0123, 0.0071, r - 0.02},
      again_m{0.0123, 0.0071, r - aim_m};
  const RigRun run =
      rig.run(plate(0.04), away_m,
              {Rig::hold_s(0.3), rig.to(deep_m, 0.05), Rig::hold_s(3), rig.to(away_m, 0.05),
               rig.to(again_m, 0.05), Rig::hold_s(1), "at 2 s set contact_stiffness 2000 N/m"},
              contact, {{"contact_stiffness", "100 N/m"}});
  const size_t begin = 1900, end = 3600;
  const std::vector<double> sum_J = work_J(run, begin, end);
  double fastest_mps = 0, jump_N = 0;
  for (size_t i = begin + 1; i < end; ++i) {
    fastest_mps = std::max(fastest_mps, norm(run[i].device_m - run[i - 1].device_m) * 1000);
    jump_N = std::max(jump_N, norm(run[i].force_N - run[i - 1].force_N));
  }
  const double given_mJ = 1e3 * *std::max_element(sum_J.begin(), sum_J.end());
  if (contact == Contact::kPenalty) {
    report.bar_at_least("the same of penalty contact: energy given", of, given_mJ, "mJ", 1.5,
                        "it shows that the bar can fail");
    return;
  }
  const double series = 2000 * rig.grip_N_per_m / (2000 + rig.grip_N_per_m);
  report.bar("100 to 2,000 N/m under load: energy given", of, given_mJ, "mJ", 1.5);
  report.bar("100 to 2,000 N/m under load: speed", of, fastest_mps, "m/s", 0.05);
  report.bar("100 to 2,000 N/m under load: largest step of the force", of, jump_N, "N", 0.02);
  report.bar("next contact: force, off the closed form", of,
             std::fabs(mean_force_N(run, 500).z - series * aim_m), "N",
             0.005 * series * aim_m + 0.03,
             "closed form " + bench::number_text(series * aim_m) + " N");
}

// A hand that goes from place to place about a solid, in and out of it.
std::vector<std::string> random_script(const Rig& rig, tools::Random& random, double reach_m,
                                       double stiffest_N_per_m, int moves) {
  std::vector<std::string> script = {Rig::hold_s(0.3)};
  for (int i = 0; i < moves; ++i) {
    const auto draw = [&] { return random.between(-reach_m, reach_m); };
    const double x = draw(), y = draw(), z = random.between(-0.01, 0.012);
    script.push_back(rig.to({x, y, z}, 0.02 * std::pow(25, random.uniform())));
    script.push_back(Rig::hold_s(random.between(0.05, 0.4)));
  }
  struct Drawn {
    const char* key;
    double low, high;
    const char* unit;
  };
  const Drawn drawn[] = {{"contact_stiffness", 100, stiffest_N_per_m, "N/m"},
                         {"contact_damping", 0, 2, "N*s/m"},
                         {"tool_radius", 0.0005, 0.006, "m"},
                         {"friction_static", 0, 1, ""},
                         {"friction_dynamic", 0, 1, ""}};
  for (int i = 0; i < 2 * moves; ++i) {
    const Drawn& row = drawn[random.below(5)];
    const double value = random.between(row.low, row.high), at_s = 0.4 + 0.2 * i;
    script.push_back("at " + with_unit(at_s, "s") + " set " + row.key + " " +
                     with_unit(value, row.unit));
  }
  return script;
}

// The observer with its initial reservoir, or one that never empties.
Lines reservoir(bool is_limited) {
  return is_limited ? Lines{} : Lines{{"energy_reservoir", "1000 J"}};
}

// Adds a bar that the observer meets, or one that shows that it fails without.
void add_gain(const std::string& what, const std::string& of, double gain_J, bool is_limited,
              const std::string& remark, bench::Report& report) {
  if (is_limited)
    report.bar(what, of, 1e3 * gain_J, "mJ", 1, remark);
  else
    report.bar_at_least(what, of + ", not limited", 1e3 * gain_J, "mJ", 1, remark);
}

// Stiffness, damping, radius and friction change at random, mostly under load.
void random_hands(double stiffest_N_per_m, uint64_t hands, bool is_limited, bench::Report& report) {
  double worst_J = 0, ticks = 0, faults = 0;
  uint64_t worst_seed = 0;
  for (uint64_t seed = 1; seed <= hands; ++seed) {
    const Rig rig(seed);
    tools::Random random(seed);
    const Solid solids[] = {plate(0.04), two_walls(), three_walls(), groove(rig.half_angle_rad)};
    const Vec start_m{seed % 4 == 1 ? -0.02 : 0.02, seed % 4 == 2 ? 0.02 : 0.0, 0.03};
    const RigRun run =
        rig.run(solids[seed % 4], start_m, random_script(rig, random, 0.02, stiffest_N_per_m, 20),
                Contact::kProxy, reservoir(is_limited));
    const double given_J = gain_J(run);
    ticks += static_cast<double>(run.size());
    faults += run.back().faults != 0;
    if (given_J > worst_J) worst_J = given_J, worst_seed = seed;
  }
  add_gain("random hands and settings: energy given",
           "to " + bench::number_text(stiffest_N_per_m) + " N/m", worst_J, is_limited,
           bench::number_text(ticks) + " ticks; worst: seed " + std::to_string(worst_seed) + ", " +
               bench::number_text(faults) + " faults",
           report);
}

// A hand that knocks on a plate, as shares of their ranges.
struct Knock {
  static constexpr int kSize = 7;
  double share[kSize];
};

double knock_gain_J(const Knock& knock, bool is_limited) {
  const auto in_range = [&](int i, double low, double high) {
    return low * std::pow(high / low, knock.share[i]);
  };
  const Rig rig(0);
  const Vec up_m{0.0123, 0.0071, rig.radius_m + in_range(0, 1e-4, 0.02)},
      down_m{0.0123, 0.0071, rig.radius_m - in_range(1, 1e-4, 0.02)};
  const double speed_mps = in_range(2, 0.02, 2);
  Lines settings = reservoir(is_limited);
  settings.emplace_back("hand_stiffness", with_unit(in_range(3, 50, 3000), "N/m"));
  settings.emplace_back("hand_damping", with_unit(in_range(4, 0.01, 20), "N*s/m"));
  settings.emplace_back("contact_stiffness", with_unit(in_range(5, 500, 20000), "N/m"));
  settings.emplace_back("contact_damping", with_unit(in_range(6, 0.01, 10), "N*s/m"));
  std::vector<std::string> script = {Rig::hold_s(0.3)};
  for (int i = 0; i < 10; ++i) {
    script.push_back(rig.to(down_m, speed_mps));
    script.push_back(rig.to(up_m, speed_mps));
  }
  script.push_back(Rig::hold_s(0.3));
  return gain_J(rig.run(plate(0.04), up_m, script, Contact::kProxy, settings));
}

// Hill climbing from random hands for the one that gains most.
void worst_hand(int starts, int tries, bool is_limited, bench::Report& report) {
  tools::Random random(1);
  Knock worst{};
  double worst_J = 0;
  for (int start = 0; start < starts; ++start) {
    Knock best{};
    for (double& share : best.share) share = random.uniform();
    double best_J = knock_gain_J(best, is_limited);
    for (int attempt = 0; attempt < tries; ++attempt) {
      Knock next = best;
      double& share = next.share[random.below(Knock::kSize)];
      share = std::clamp(share + random.between(-0.3, 0.3), 0.0, 1.0);
      const double next_J = knock_gain_J(next, is_limited);
      if (next_J >= best_J) best = next, best_J = next_J;
    }
    if (best_J > worst_J) worst = best, worst_J = best_J;
  }
  std::string remark = "shares:";
  for (const double share : worst.share) remark += " " + bench::number_text(share);
  add_gain("worst hand found by hill climbing: energy given", "to 20000 N/m", worst_J, is_limited,
           remark, report);
}

}  // namespace

// Energy that contact gives to the hand: work of the motors.
void run_passivity_bench(const bench::Options& options, bench::Report& report) {
  for (uint64_t seed = 0; seed < (options.is_long ? 20u : 5u); ++seed)
    raise_under_load(Rig(seed), seed == 0 ? "upright" : "seed " + std::to_string(seed),
                     Contact::kProxy, report);
  raise_under_load(Rig(0), "upright", Contact::kPenalty, report);
  for (const bool is_limited : {true, false}) {
    for (const double stiffest_N_per_m : {5000.0, 20000.0})
      random_hands(stiffest_N_per_m, options.is_long ? 800 : 40, is_limited, report);
    worst_hand(options.is_long ? 40 : 8, 25, is_limited, report);
  }
}

}  // namespace firmtouch::host_sim
