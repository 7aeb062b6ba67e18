#include <algorithm>
#include <cmath>

#include "host_sim/bench/benches.hpp"
#include "host_sim/bench/passive_hands.hpp"

namespace firmtouch::host_sim {
namespace {

// Work of the motors on the device.
std::vector<double> work_J(const RigRun& run, size_t begin, size_t end) {
  std::vector<double> sum_J = {0};
  for (size_t i = begin + 1; i < end; ++i)
    sum_J.push_back(sum_J.back() + dot(run[i - 1].motor_N, run[i].device_m - run[i - 1].device_m));
  return sum_J;
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

constexpr const char* kEachTick = "1000 Hz";

// The observer with its initial reservoir, or one that never empties; models a second.
Lines settings(bool is_limited, const std::string& rate) {
  Lines lines;
  if (!is_limited) lines.emplace_back("energy_reservoir", "1000 J");
  if (rate != kEachTick) lines.emplace_back("geometry_rate", rate);
  return lines;
}

// Adds a bar that the observer meets, or one that shows that it fails without.
void add(const std::string& what, const std::string& of, const HandsGain& hands, bool is_limited,
         bench::Report& report) {
  const double gain_mJ = 1e3 * hands.worst_J;
  const std::string remark = bench::number_text(hands.ticks) + " ticks, " +
                             std::to_string(hands.faulted) +
                             " hands with a fault; worst: " + hands.worst;
  if (is_limited)
    report.bar(what, of, gain_mJ, "mJ", 1, remark);
  else
    report.bar_at_least(what, of + ", not limited", gain_mJ, "mJ", 1, remark);
}

}  // namespace

// Energy that contact gives to the hand: work of the motors.
void run_passivity_bench(const bench::Options& options, bench::Report& report) {
  for (uint64_t seed = 0; seed < (options.is_long ? 20u : 5u); ++seed)
    raise_under_load(Rig(seed), seed == 0 ? "upright" : "seed " + std::to_string(seed),
                     Contact::kProxy, report);
  raise_under_load(Rig(0), "upright", Contact::kPenalty, report);
  const uint32_t hands = options.is_long ? 800 : 40;
  for (const bool is_limited : {true, false}) {
    const auto row = [&](const char* what, double stiffest_N_per_m, const char* rate,
                         auto hands_of) {
      add(what, "to " + bench::number_text(stiffest_N_per_m) + " N/m, models at " + rate,
          hands_of(stiffest_N_per_m, settings(is_limited, rate)), is_limited, report);
    };
    const auto about_solids = [&](double stiffest_N_per_m, const Lines& lines) {
      return random_hands("", stiffest_N_per_m, hands, lines);
    };
    const auto about_guides = [&](double stiffest_N_per_m, const Lines& lines) {
      return guided_hands("", stiffest_N_per_m, hands, lines);
    };
    const auto about_both = [&](double stiffest_N_per_m, const Lines& lines) {
      return guided_hands("", stiffest_N_per_m, hands, lines, About::kGuideInSolid);
    };
    const auto worst_of = [&](Against against, uint32_t starts, uint32_t tries) {
      return [=](double stiffest_N_per_m, const Lines& lines) {
        return worst_hand("", stiffest_N_per_m, against, starts, tries, lines);
      };
    };
    const char* const random = "random hands, settings change: energy given";
    row(random, 5000, kEachTick, about_solids);
    row(random, 20000, kEachTick, about_solids);
    row(random, 20000, "50 Hz", about_solids);
    const char* const guided = "random hands about a guide, settings change: energy given";
    row(guided, 5000, kEachTick, about_guides);
    row(guided, 5000, "200 Hz", about_guides);
    row(guided, 5000, "50 Hz", about_guides);
    const char* const both = "random hands about a guide in a solid: energy given";
    row(both, 5000, kEachTick, about_both);
    row(both, 20000, kEachTick, about_both);
    row(both, 5000, "50 Hz", about_both);
    row("worst hand found by hill climbing: energy given", 20000, kEachTick,
        worst_of(Against::kPlate, options.is_long ? 40 : 8, 25));
    row("worst hand about a guide found by hill climbing: energy given", 20000, "50 Hz",
        worst_of(Against::kGuide, options.is_long ? 40 : 4, 100));
  }
}

}  // namespace firmtouch::host_sim
