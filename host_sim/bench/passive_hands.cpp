#include "host_sim/bench/passive_hands.hpp"

#include <algorithm>
#include <cmath>

#include "bench/report.hpp"
#include "firmtouch/servo/fault.hpp"
#include "host_sim/hand/hands.hpp"
#include "surface/random.hpp"

namespace firmtouch::host_sim {
namespace {

// Of random hands; a linkage that is pushed out of its ranges faults, and renders nothing any more.
constexpr double kReachOfLinkage_m = 0.012;

// A spring of 100 N/m or more, the softest here, then holds 12 uJ at most: where the force was as
// small for so long. It lags behind a line that is another one, and passes 0 where it turns.
constexpr double kSlack_N = 0.05;
constexpr uint32_t kSlackTicks = 25;
constexpr double kAtProxy_m = 1e-7;

double in_range(double share, double low, double high) { return low * std::pow(high / low, share); }

void add_hand(double stiffness_share, double damping_share, Lines& to) {
  to.emplace_back("hand_stiffness", with_unit(in_range(stiffness_share, 50, 3000), "N/m"));
  to.emplace_back("hand_damping", with_unit(in_range(damping_share, 0.01, 20), "N*s/m"));
}

// A setting that changes at random.
struct Drawn {
  const char* key;
  double low, high;
  const char* unit;
};

// A hand that goes from place to place within `reach_m` and these heights, while settings change.
std::vector<std::string> random_script(tools::Random& random, double reach_m, double low_m,
                                       double high_m, int moves, const std::vector<Drawn>& drawn) {
  std::vector<std::string> script = {Rig::hold_s(0.3)};
  for (int i = 0; i < moves; ++i) {
    const auto draw = [&] { return random.between(-reach_m, reach_m); };
    const double x = draw(), y = draw(), z = random.between(low_m, high_m);
    script.push_back(Rig::to({x, y, z}, 0.02 * std::pow(25, random.uniform())));
    script.push_back(Rig::hold_s(random.between(0.05, 0.4)));
  }
  for (int i = 0; i < 2 * moves; ++i) {
    const Drawn& row = drawn[random.below(static_cast<uint32_t>(drawn.size()))];
    const double value = random.between(row.low, row.high), at_s = 0.4 + 0.2 * i;
    script.push_back("at " + with_unit(at_s, "s") + " set " + row.key + " " +
                     with_unit(value, row.unit));
  }
  return script;
}

// Of the ranges of what a search changes: of a hand that knocks on a plate, or pulls at a guide.
constexpr size_t kOfKnock = 7, kOfPull = 3 * 6 + 8;
using Shares = std::vector<double>;

std::vector<std::string> to_and_fro(const std::vector<Vec>& stops_m, double speed_mps, int times,
                                    double rest_s) {
  std::vector<std::string> script = {Rig::hold_s(0.3)};
  for (int i = 0; i < times; ++i)
    for (const Vec stop_m : stops_m) {
      script.push_back(Rig::to(stop_m, speed_mps));
      if (rest_s > 0) script.push_back(Rig::hold_s(rest_s));
    }
  script.push_back(Rig::hold_s(0.3));
  return script;
}

RigRun knock(const Rig& rig, const Shares& share, double stiffest_N_per_m, Lines settings) {
  const Vec up_m{0.0123, 0.0071, rig.radius_m + in_range(share[0], 1e-4, 0.02)},
      down_m{0.0123, 0.0071, rig.radius_m - in_range(share[1], 1e-4, 0.02)};
  const double speed_mps = in_range(share[2], 0.02, 2);
  add_hand(share[3], share[4], settings);
  settings.emplace_back("contact_stiffness",
                        with_unit(in_range(share[5], 500, stiffest_N_per_m), "N/m"));
  settings.emplace_back("contact_damping", with_unit(in_range(share[6], 0.01, 10), "N*s/m"));
  return rig.run(plate(0.04), up_m, to_and_fro({down_m, up_m}, speed_mps, 10, 0), Contact::kProxy,
                 settings);
}

// From stop to stop among four corners of a guide, whose stiffness changes between two.
RigRun pull(const Rig& rig, const Shares& share, double stiffest_N_per_m, Lines settings) {
  std::vector<Vec> places_m;
  for (size_t i = 0; i < 6; ++i) {
    const double* at = &share[3 * i];
    places_m.push_back(Vec{2 * at[0] - 1, 2 * at[1] - 1, 2 * at[2] - 1} * kReachOfLinkage_m);
  }
  const std::vector<Vec> points_m(places_m.begin(), places_m.begin() + 4);
  const double* drawn = &share[3 * 6];
  add_hand(drawn[0], drawn[1], settings);
  settings.emplace_back("guide_stiffness",
                        with_unit(in_range(drawn[2], 100, stiffest_N_per_m), "N/m"));
  settings.emplace_back("guide_damping", with_unit(in_range(drawn[3], 0.01, 10), "N*s/m"));
  settings.emplace_back("guide_arc_penalty", with_unit(0.5 * drawn[4], ""));
  for (const char* key : {"guide_snap", "guide_release"}) settings.emplace_back(key, "0.5 m");
  const double speed_mps = in_range(drawn[5], 0.05, 2);
  std::vector<std::string> script =
      to_and_fro({places_m[4], places_m[1], places_m[5], places_m[2]}, speed_mps, 4, 0.06);
  for (int i = 0; i < 20; ++i)
    script.push_back("at " + with_unit(0.4 + in_range(drawn[6], 0.01, 0.5) * i, "s") +
                     " set guide_stiffness " +
                     with_unit(in_range(drawn[i % 2 == 0 ? 7 : 2], 100, stiffest_N_per_m), "N/m"));
  return rig.run_guided(points_m, points_m[0], script, settings);
}

// Result: its gain.
double add(const RigRun& run, HandsGain& to) {
  to.ticks += static_cast<double>(run.size());
  to.hands += 1;
  to.faulted += run.back().faults != 0;
  to.overdrawn += (run.back().faults & servo::kFaultEnergy) != 0;
  to.touched += std::any_of(run.begin(), run.end(), [](const RigTick& tick) {
    return tick.is_on && (tick.depth_m > 0 || tick.is_guided);
  });
  return gain_J(run);
}

// The runs of seeds from 1.
template <class RunOf>
HandsGain of_seeds(uint32_t hands, const RunOf& run_of) {
  HandsGain all;
  for (uint64_t seed = 1; seed <= hands; ++seed) {
    const double gain_J = add(run_of(seed), all);
    if (gain_J > all.worst_J) all.worst_J = gain_J, all.worst = "seed " + std::to_string(seed);
  }
  return all;
}

}  // namespace

double gain_J(const RigRun& run) {
  double most_J = -HUGE_VAL, gain_J = 0;
  uint32_t slack_ticks = 0;
  for (const RigTick& tick : run) {
    slack_ticks = tick.is_guided && norm(tick.force_N) > kSlack_N ? 0 : slack_ticks + 1;
    if (!tick.is_ramped_in && most_J > -HUGE_VAL) break;
    // At two rates the depth is that of another tick, where a model is not of this one.
    const bool is_touching = tick.depth_m > 0 || norm(tick.proxy_m - tick.position_m) > kAtProxy_m;
    const bool holds_energy = is_touching || (tick.is_guided && slack_ticks < kSlackTicks);
    if (!tick.is_ramped_in || holds_energy) continue;
    most_J = std::max(most_J, tick.taken_J);
    gain_J = std::max(gain_J, most_J - tick.taken_J);
  }
  return gain_J;
}

RigRun random_run(const std::string& machine, double stiffest_N_per_m, uint64_t seed,
                  Lines settings) {
  const Rig rig(seed, machine);
  tools::Random random(seed);
  const Solid solids[] = {plate(0.04), two_walls(), three_walls(), groove(rig.half_angle_rad)};
  const double reach_m = machine.empty() ? 0.02 : kReachOfLinkage_m;
  const Vec start_m{seed % 4 == 1 ? -reach_m : reach_m, seed % 4 == 2 ? reach_m : 0, 1.5 * reach_m};
  const auto script = random_script(random, reach_m, -0.01, 0.012, 20,
                                    {{"contact_stiffness", 100, stiffest_N_per_m, "N/m"},
                                     {"contact_damping", 0, 2, "N*s/m"},
                                     {"tool_radius", 0.0005, 0.006, "m"},
                                     {"friction_static", 0, 1, ""},
                                     {"friction_dynamic", 0, 1, ""}});
  const bool has_mass = std::any_of(settings.begin(), settings.end(),
                                    [](const auto& line) { return line.first == "hand_mass"; });
  if (!machine.empty() && !has_mass) add_hand(random.uniform(), random.uniform(), settings);
  return rig.run(solids[seed % 4], start_m, script, Contact::kProxy, settings);
}

RigRun random_guided_run(const std::string& machine, double stiffest_N_per_m, uint64_t seed,
                         Lines settings, About about) {
  const Rig rig(seed, machine);
  tools::Random random(seed);
  const double reach_m = machine.empty() ? 0.02 : kReachOfLinkage_m;
  const auto draw = [&] { return random.between(-reach_m, reach_m); };
  std::vector<Vec> points_m;
  for (uint32_t i = 0; i < 3 + seed % 20; ++i) {
    const double x = draw(), y = draw();
    points_m.push_back({x, y, 0.6 * draw()});
  }
  const bool is_solid = about == About::kGuideInSolid;
  const Vec start_m = is_solid ? Vec{reach_m, 0, 1.5 * reach_m} : points_m[0];
  std::vector<Drawn> drawn = {{"guide_stiffness", 100, stiffest_N_per_m, "N/m"},
                              {"guide_damping", 0, 2, "N*s/m"},
                              {"guide_tunnel", 0, 0.002, "m"},
                              {"guide_side_z", -1, 1, ""},
                              {"guide_arc_penalty", 0, 0.5, ""}};
  if (is_solid)
    drawn.insert(drawn.end(), {{"contact_stiffness", 100, stiffest_N_per_m, "N/m"},
                               {"contact_damping", 0, 2, "N*s/m"},
                               {"tool_radius", 0.0005, 0.006, "m"},
                               {"friction_static", 0, 1, ""}});
  const auto script = random_script(random, reach_m, -0.6 * reach_m, 0.6 * reach_m, 20, drawn);
  if (!machine.empty()) add_hand(random.uniform(), random.uniform(), settings);
  for (const char* key : {"guide_snap", "guide_release"}) settings.emplace_back(key, "0.5 m");
  const Solid solids[] = {plate(0.04), two_walls(), three_walls(), groove(rig.half_angle_rad)};
  return rig.run_guided(points_m, start_m, script, settings,
                        is_solid ? &solids[seed % 4] : nullptr);
}

HandsGain random_hands(const std::string& machine, double stiffest_N_per_m, uint32_t hands,
                       const Lines& settings) {
  return of_seeds(
      hands, [&](uint64_t seed) { return random_run(machine, stiffest_N_per_m, seed, settings); });
}

HandsGain guided_hands(const std::string& machine, double stiffest_N_per_m, uint32_t hands,
                       const Lines& settings, About about) {
  return of_seeds(hands, [&](uint64_t seed) {
    return random_guided_run(machine, stiffest_N_per_m, seed, settings, about);
  });
}

HandsGain massive_hands(const std::string& machine, double stiffest_N_per_m, uint32_t hands,
                        const Lines& settings) {
  HandsGain all;
  for (uint64_t seed = 1; seed <= hands; ++seed) {
    const KnownHand& known = known_hands()[seed / 3 % known_hands().size()];
    const HandModel& grip = seed % 3 == 0 ? known.weak : seed % 3 == 1 ? known.mean : known.firm;
    Lines lines = settings;
    for (const HandKey& key : hand_keys())
      lines.emplace_back(key.name, with_unit(grip.*key.member, key.unit));
    const double gain_J = add(random_run(machine, stiffest_N_per_m, seed, lines), all);
    if (gain_J <= all.worst_J) continue;
    all.worst_J = gain_J;
    all.worst = std::string(known.name) + ", seed " + std::to_string(seed);
  }
  return all;
}

HandsGain worst_hand(const std::string& machine, double stiffest_N_per_m, Against against,
                     uint32_t starts, uint32_t tries, const Lines& settings) {
  const bool is_guided = against == Against::kGuide;
  HandsGain all;
  tools::Random random(1);
  for (uint32_t start = 0; start < starts; ++start) {
    const Rig rig(machine.empty() ? 0 : start + 1, machine);
    const auto gain_of = [&](const Shares& by) {
      return add((is_guided ? pull : knock)(rig, by, stiffest_N_per_m, settings), all);
    };
    Shares best(is_guided ? kOfPull : kOfKnock);
    for (double& share : best) share = random.uniform();
    double best_J = gain_of(best);
    for (uint32_t attempt = 0; attempt < tries; ++attempt) {
      Shares next = best;
      double& share = next[random.below(static_cast<uint32_t>(next.size()))];
      share = std::clamp(share + random.between(-0.3, 0.3), 0.0, 1.0);
      const double next_J = gain_of(next);
      if (next_J >= best_J) best = next, best_J = next_J;
    }
    if (best_J <= all.worst_J) continue;
    all.worst_J = best_J;
    all.worst = "start " + std::to_string(start) + ", shares";
    for (const double share : best) all.worst += " " + bench::number_text(share);
  }
  return all;
}

}  // namespace firmtouch::host_sim
