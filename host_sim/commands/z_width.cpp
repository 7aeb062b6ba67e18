#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <iostream>
#include <sstream>
#include <string>

#include "device/machines.hpp"
#include "firmtouch/params/table.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/device/linkage_body.hpp"
#include "host_sim/device/workspace.hpp"
#include "host_sim/plant/sampled_wall.hpp"
#include "json/json.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kDegrees = 57.295779513082323;

// Mass, own damping and period of the free rows; each at B of 0, a little and much.
struct FreeAxis {
  double mass_kg, viscous, period_s, damping[3];
};
constexpr FreeAxis kAxes[] = {
    {.050, .2, 1e-3, {0, .1, 2}},    {.050, .2, .25e-3, {0, .1, 2}}, {.075, .5, 1e-3, {0, .25, 5}},
    {.075, .5, .25e-3, {0, .25, 5}}, {.075, .5, .1e-3, {0, .25, 5}}, {.200, 1., 1e-3, {0, .5, 10}},
};
// Mass, damper and spring of hands: a light and a firm grip.
struct Held {
  double mass_kg, damping, stiffness;
};
constexpr Held kHands[] = {{.05, 2, 100}, {.15, 6, 700}};

// 18 rows without delay, 6 of one sample, 4 of two.
std::vector<SampledWall> free_rows() {
  std::vector<SampledWall> rows;
  for (const FreeAxis& axis : kAxes)
    for (const double damping : axis.damping)
      rows.push_back({axis.mass_kg, axis.viscous, axis.period_s, damping, 0, 0, 0, 0});
  for (uint32_t i = 0; i < 10; ++i) {
    const FreeAxis& axis = kAxes[i % 6];
    rows.push_back(
        {axis.mass_kg, axis.viscous, axis.period_s, axis.damping[2], 1 + i / 6, 0, 0, 0});
  }
  return rows;
}

std::vector<SampledWall> held_rows() {
  std::vector<SampledWall> rows;
  for (const FreeAxis& axis : kAxes)
    for (const Held& hand : kHands)
      rows.push_back({axis.mass_kg, axis.viscous, axis.period_s, axis.damping[1],
                      static_cast<uint32_t>(rows.size() / 2 % 2), hand.mass_kg, hand.damping,
                      hand.stiffness});
  return rows;
}

// Result: the largest relative error.
double print_rows(const std::vector<SampledWall>& rows) {
  std::printf(
      "  mass  own b  T ms     B  delay  hand kg  N s/m   N/m   passive   delayed     exact"
      "  simulated  error\n");
  double worst = 0;
  for (const SampledWall& row : rows) {
    const double exact = exact_limit_N_per_m(row), simulated = simulated_limit_N_per_m(row);
    const double error = simulated / exact - 1;
    worst = std::max(worst, std::isfinite(error) ? std::fabs(error) : HUGE_VAL);
    std::printf("%6.3f %6.2f %5.2f %5.2f %6u %8.2f %6.1f %5.0f %9.0f %9.0f %9.0f %10.0f %5.2f %%\n",
                row.mass_kg, row.viscous_N_s_per_m, row.period_s * 1e3, row.damping_N_s_per_m,
                row.delay_samples, row.hand_mass_kg, row.hand_damping_N_s_per_m,
                row.hand_stiffness_N_per_m, passive_limit_N_per_m(row), delayed_limit_N_per_m(row),
                exact, simulated, error * 100);
  }
  return worst;
}

int verdict(bool is_met, const std::string& bar) {
  std::cout << (is_met ? "met: " : "NOT MET: ") << bar << "\n";
  return is_met ? 0 : 1;
}

int print_table() {
  const std::vector<SampledWall> free = free_rows(), held = held_rows();
  std::printf("Stiffest stable wall in N/m, %zu free axes\n", free.size());
  const double worst_free = print_rows(free);
  std::printf("\nThe same of %zu axes that a hand holds\n", held.size());
  const double worst_held = print_rows(held);
  char text[120];
  std::snprintf(text, sizeof text, "largest error %.2f %% free, %.2f %% held; bar 1 %%",
                worst_free * 100, worst_held * 100);
  return verdict(worst_free <= 0.01 && worst_held <= 0.01, text);
}

int print_regimes() {
  constexpr const char* kName[] = {"rest", "limit cycle", "rest from near, growth from far",
                                   "growth"};
  // b / (K T) and f / (K quantum): four points a regime. Below b / (K T) of about 0.8 a
  // cycle spans more than a quantum, above 0.3 a locked one survives within growth.
  constexpr double kPoints[16][2] = {{.6, .6}, {.6, 1}, {1, .6},   {2, .8},  {.8, 0}, {1.2, 0},
                                     {1.6, 0}, {2, 0},  {.25, .6}, {.4, .6}, {.1, 1}, {.25, 2},
                                     {.05, 0}, {.1, 0}, {.2, 0},   {.3, 0}};
  std::printf(
      "500 N/m on 100 g, 1 kHz, 30 um. Amplitudes in quanta: of the "
      "cycle with the period seen, or of the one between rest and growth\n"
      " b/KT  f/Kq  predicted                         simulated                        "
      " predicted simulated\n");
  int wrong = 0;
  double worst = 0;
  for (const auto& point : kPoints) {
    QuantisedWall wall;
    wall.viscous_N_s_per_m = point[0] * wall.stiffness_N_per_m * wall.period_s;
    wall.coulomb_N = point[1] * wall.stiffness_N_per_m * wall.quantum_m;
    const Motion seen = simulated_motion(wall);
    Motion predicted = predicted_motion(wall);
    if (predicted.regime == Regime::kCycle)
      predicted.amplitude_m = cycle_amplitude_m(wall, seen.half_period_ticks);
    std::printf("%5.2f %5.3f  %-32s  %-32s %9.2f %9.2f\n", point[0], point[1],
                kName[static_cast<int>(predicted.regime)], kName[static_cast<int>(seen.regime)],
                predicted.amplitude_m / wall.quantum_m, seen.amplitude_m / wall.quantum_m);
    wrong += predicted.regime != seen.regime;
    if (predicted.regime == Regime::kCycle || predicted.regime == Regime::kRests)
      worst = std::max(worst, std::fabs(seen.amplitude_m / predicted.amplitude_m - 1));
  }
  char text[120];
  std::snprintf(text, sizeof text,
                "%d of 16 regimes wrong, amplitudes within %.1f %%; bar 0, 10 %%", wrong,
                worst * 100);
  return verdict(wrong == 0 && worst <= 0.1, text);
}

int print_estimators() {
  constexpr double kQuantum_m = 30e-6, kBar_N_per_m = 1.15 * 7286;
  constexpr double kPeriod_s[] = {1e-3, .25e-3, .1e-3};
  const auto initial = static_cast<uint32_t>(params::kTable[params::kVelocityEstimator].initial);
  std::printf(
      "Stiffest wall at rest in N/m: 75 g, b 0.5 N s/m, B 5 N s/m, 30 um, pushed with 1 N\n"
      "estimator               1 kHz   4 kHz  10 kHz\n");
  double of_default = 0;
  for (uint32_t i = 0; i < bench::all_estimates(kQuantum_m, kPeriod_s[0]).size(); ++i) {
    double limit[3];
    const char* name = nullptr;
    for (int k = 0; k < 3; ++k) {
      const bench::NamedEstimate one = bench::all_estimates(kQuantum_m, kPeriod_s[k])[i];
      limit[k] = rest_limit_N_per_m({.075, .5, kPeriod_s[k], 5}, kQuantum_m, one);
      name = one.name;
    }
    std::printf("%-22s %6.0f %7.0f %7.0f%s\n", name, limit[0], limit[1], limit[2],
                i == initial ? "   default" : "");
    if (i == initial) of_default = limit[0];
  }
  char text[120];
  std::snprintf(text, sizeof text, "default at 1 kHz %.0f N/m; bar %.0f", of_default, kBar_N_per_m);
  return verdict(of_default >= kBar_N_per_m, text);
}

std::string json_of(const SampledWall& wall) {
  tools::Json limits;
  limits.add("mass_kg", wall.mass_kg).add("viscous_N_s_per_m", wall.viscous_N_s_per_m);
  limits.add("damping_N_s_per_m", wall.damping_N_s_per_m);
  limits.add("passive_N_per_m", passive_limit_N_per_m(wall));
  limits.add("delayed_N_per_m", delayed_limit_N_per_m(wall));
  limits.add("exact_N_per_m", exact_limit_N_per_m(wall));
  limits.add("simulated_N_per_m", simulated_limit_N_per_m(wall));
  return limits.object();
}

// Where the tip moves most easily: its least mass and its least damping, as if in one direction.
struct DevicePose {
  const char* name;
  tools::JointMotion at;
};

// "30,45,-20", of each joint.
tools::JointMotion pose_of(const cli::Arguments& options, const device::JointSettings& joints) {
  std::istringstream text(options.text("--at"));
  tools::JointMotion at;
  std::string part;
  for (uint32_t k = 0; k < joints.joints; ++k) {
    char* end = nullptr;
    const bool has_part = static_cast<bool>(std::getline(text, part, ','));
    at.angle_rad[k] = has_part ? std::strtod(part.c_str(), &end) / kDegrees : 0;
    if (end == nullptr || end == part.c_str() || *end != 0 || !std::isfinite(at.angle_rad[k]))
      options.refuse("--at takes " + std::to_string(joints.joints) + " angles in degrees: 30,45");
    if (!(at.angle_rad[k] >= static_cast<double>(joints.joint[k].low_rad) &&
          at.angle_rad[k] <= static_cast<double>(joints.joint[k].high_rad)))
      options.refuse("--at: the angle of joint " + std::to_string(k) + " is out of its range");
  }
  if (std::getline(text, part)) options.refuse("--at has more angles than the device joints");
  return at;
}

int print_device_walls(const cli::Arguments& options, SampledWall wall) {
  for (const char* own : {"--mass", "--viscous", "--damping"})
    if (options.has(own)) options.refuse(std::string(own) + " comes from the device");
  const std::string path = options.positionals()[0];
  const tools::LinkageDevice device = tools::read_device(path, tools::read_device_text(path));
  const Workspace space = workspace_of(device, device.joints.joints == 3 ? 40 : 400);
  if (!(space.least_mass_kg > 0))
    throw tools::Refused(path + ": no pose has a mass: state the masses of links or tip");
  const DevicePose poses[] = {
      {"where the tip is lightest", space.lightest_at},
      {options.has("--at") ? "at the pose of --at" : "in the middle of the ranges",
       options.has("--at") ? pose_of(options, device.joints) : middle_of(device)}};
  for (const DevicePose& pose : poses)
    if (!(tools::tip_figures(device, pose.at).least_mass_kg > 0))
      throw tools::Refused(path + ": the links do not meet " + pose.name +
                           "; name angles where they do: --at");
  tools::Json all;
  for (const DevicePose& pose : poses) {
    const tools::TipFigures tip = tools::tip_figures(device, pose.at);
    wall.mass_kg = tip.least_mass_kg;
    wall.viscous_N_s_per_m = tip.least_damping_N_s_per_m;
    std::vector<SampledWall> rows;
    for (const double damping : {0.0, 0.25, 0.5, 1.0, 2.0, 5.0, 10.0}) {
      if (!(damping + wall.viscous_N_s_per_m > 0)) continue;  // no wall is stable
      rows.push_back(wall);
      rows.back().damping_N_s_per_m = damping;
    }
    if (options.has("--json")) {
      all.add(&pose == poses ? "lightest" : "pose", tools::json_list(rows, json_of));
      continue;
    }
    std::printf("%sWalls in N/m %s, joints", &pose == poses ? "" : "\n", pose.name);
    for (uint32_t k = 0; k < device.joints.joints; ++k)
      std::printf(" %.1f", pose.at.angle_rad[k] * kDegrees);
    std::printf(" deg\n");
    print_rows(rows);
  }
  if (options.has("--json")) std::cout << all.object() << "\n";
  return 0;
}

int print_z_width(const cli::Arguments& options) {
  for (const char* const table : {"--table", "--regimes", "--estimators"})
    if (options.has(table) && options.words().size() > 1)
      options.refuse(std::string(table) + " has axes of its own: give it alone");
  if (options.has("--table")) return print_table();
  if (options.has("--regimes")) return print_regimes();
  if (options.has("--estimators")) return print_estimators();
  SampledWall wall;
  wall.mass_kg = options.number("--mass", wall.mass_kg, 0);
  wall.viscous_N_s_per_m = options.number("--viscous", wall.viscous_N_s_per_m, 0);
  const double rate_Hz = options.number("--rate", 1000, 50);
  if (!(rate_Hz <= 1e5)) options.refuse("--rate takes 50 to 100000 Hz");
  wall.period_s = 1 / rate_Hz;
  wall.damping_N_s_per_m = options.number("--damping", 0, 0);
  const double delay = options.number("--delay", 0, 0);
  if (std::floor(delay) < delay || delay > 8) options.refuse("--delay takes 0 to 8 whole samples");
  if (!(wall.mass_kg > 0)) options.refuse("--mass must exceed 0");
  wall.delay_samples = static_cast<uint32_t>(delay);
  wall.hand_mass_kg = options.number("--hand-mass", 0, 0);
  wall.hand_damping_N_s_per_m = options.number("--hand-damping", 0, 0);
  wall.hand_stiffness_N_per_m = options.number("--hand-stiffness", 0, 0);
  if (!options.positionals().empty()) return print_device_walls(options, wall);
  if (options.has("--at")) options.refuse("--at needs a device");
  if (options.has("--json")) {
    std::cout << json_of(wall) << "\n";
    return 0;
  }
  print_rows({wall});
  return 0;
}

}  // namespace

cli::Command z_width_command() {
  return {
      {"z-width", "[FILE|MACHINE | --table | --regimes | --estimators] [options]", 0, 1,
       print_z_width},
      "prints the stiffest passive and the stiffest stable wall of an axis, or of a device's tip",
      R"(passive: b > K T / 2 + |B| (Colgate & Schenkel 1994); delayed: K < (b + B) / (T / 2 +
delay) (Gil, Hulin & Diaz); exact: spectral radius 1 of the discrete model; simulated:
growth or decay. Of a device the axis is its tip, with its least mass and its least
damping, where it is lightest and at a pose. The observer of energy (energy_reservoir_J)
is not in these figures: it holds stiffer walls.)",
      {{"--table", nullptr, "28 free and 12 held axes; exit code 1 beyond 1 %"},
       {"--regimes", nullptr,
        "quantum and Coulomb friction: 16 points against describing functions; 1 beyond 10 %"},
       {"--estimators", nullptr, "stiffest wall at rest by velocity estimator; 1 below 8,379 N/m"},
       {"--at", "DEG,DEG...", "of a device: the joints' angles (the middle of their ranges)"},
       {"--mass", "KG", "of the axis (0.075)"},
       {"--viscous", "N_S_PER_M", "its own damping b (0.5)"},
       {"--rate", "HZ", "ticks a second (1000)"},
       {"--damping", "N_S_PER_M", "of the wall, B (0)"},
       {"--delay", "SAMPLES", "from the position to the force: 0 to 8 (0)"},
       {"--hand-mass", "KG", "that moves with the axis (0)"},
       {"--hand-damping", "N_S_PER_M", "of the hand, to the ground (0)"},
       {"--hand-stiffness", "N_PER_M", "of the hand, to the ground (0)"},
       {"--json", nullptr, "of one axis: the limits as JSON"}}};
}

}  // namespace firmtouch::host_sim
