#include <algorithm>
#include <cmath>

#include "host_sim/bench/benches.hpp"
#include "host_sim/bench/rig.hpp"
#include "surface/random.hpp"

namespace firmtouch::host_sim {
namespace {

// With the grip of a hand. Stiffer, a sampled spring gives energy, whatever the geometry does.
constexpr double kPassive_N_per_m = 2000;

// Work of the motors on the device.
std::vector<double> work_J(const RigRun& run, size_t begin, size_t end) {
  std::vector<double> sum_J = {0};
  for (size_t i = begin + 1; i < end; ++i)
    sum_J.push_back(sum_J.back() + dot(run[i - 1].motor_N, run[i].device_m - run[i - 1].device_m));
  return sum_J;
}

// The largest gain from one tick without contact to a later one: then no spring holds energy.
double gain_J(const RigRun& run) {
  const std::vector<double> sum_J = work_J(run, 0, run.size());
  double least_J = 0, gain_J = 0;
  for (size_t i = 0; i < run.size(); ++i) {
    if (run[i].depth_m > 0) continue;
    least_J = std::min(least_J, sum_J[i]);
    gain_J = std::max(gain_J, sum_J[i] - least_J);
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

// Stiffness, damping, radius and friction change at random, mostly under load.
void random_hands(double stiffest_N_per_m, uint64_t hands, bench::Report& report) {
  double worst_J = 0, ticks = 0, faults = 0;
  uint64_t worst_seed = 0;
  for (uint64_t seed = 1; seed <= hands; ++seed) {
    const Rig rig(seed);
    tools::Random random(seed);
    const Solid solids[] = {plate(0.04), two_walls(), three_walls(), groove(rig.half_angle_rad)};
    const Vec start_m{seed % 4 == 1 ? -0.02 : 0.02, seed % 4 == 2 ? 0.02 : 0.0, 0.03};
    const RigRun run =
        rig.run(solids[seed % 4], start_m, random_script(rig, random, 0.02, stiffest_N_per_m, 20));
    const double given_J = gain_J(run);
    ticks += static_cast<double>(run.size());
    faults += run.back().faults != 0;
    if (given_J > worst_J) worst_J = given_J, worst_seed = seed;
  }
  const std::string of = "to " + bench::number_text(stiffest_N_per_m) + " N/m";
  const std::string what = "random hands and settings: energy given",
                    remark = bench::number_text(ticks) + " ticks; worst: seed " +
                             std::to_string(worst_seed) + ", " + bench::number_text(faults) +
                             " faults";
  if (stiffest_N_per_m <= kPassive_N_per_m)
    report.bar(what, of, 1e3 * worst_J, "mJ", 1, remark);
  else
    report.figure(what, of, 1e3 * worst_J, "mJ", remark + "; no observer holds it back");
}

}  // namespace

// Energy that contact gives to the hand: work of the motors.
void run_passivity_bench(const bench::Options& options, bench::Report& report) {
  for (uint64_t seed = 0; seed < (options.is_long ? 20u : 5u); ++seed)
    raise_under_load(Rig(seed), seed == 0 ? "upright" : "seed " + std::to_string(seed),
                     Contact::kProxy, report);
  raise_under_load(Rig(0), "upright", Contact::kPenalty, report);
  for (const double stiffest_N_per_m : {kPassive_N_per_m, 5000.0, 20000.0})
    random_hands(stiffest_N_per_m, options.is_long ? 800 : 40, report);
}

}  // namespace firmtouch::host_sim
