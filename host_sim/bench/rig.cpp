#include "host_sim/bench/rig.hpp"

#include <algorithm>
#include <cstdio>

#include "surface/random.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kMass_kg = 0.075;

Vec wide(const float (&v)[3]) {
  return {static_cast<double>(v[0]), static_cast<double>(v[1]), static_cast<double>(v[2])};
}

std::string place(Vec at_m) {
  char text[80];
  std::snprintf(text, sizeof text, "%.9g %.9g %.9g m", at_m.x, at_m.y, at_m.z);
  return text;
}

}  // namespace

std::string with_unit(double value, const char* unit) {
  char text[40];
  std::snprintf(text, sizeof text, "%.9g %s", value, unit);
  return text;
}

Rig::Rig(uint64_t its_seed) : seed(its_seed) {
  if (seed == 0) return;
  tools::Random random(seed);
  const auto draw = [&](double low, double high) { return random.between(low, high); };
  const double x = draw(-1, 1), y = draw(-1, 1), z = draw(-1, 1);
  rotation_ = Rotation({x, y, z}, draw(0.2, 3));
  radius_m = draw(0.0015, 0.004);
  stiffness_N_per_m = draw(600, 1200);
  grip_N_per_m = draw(300, 600);
  half_angle_rad = draw(25, 60) / 57.29577951308232;
  slot_m = draw(0.8, 1.7) * radius_m;
}

double Rig::diagonal_m(const Solid& solid) const {
  return tools::diagonal_m(surface_of(solid, rotation_).vertices);
}

std::string Rig::hold_s(double time_s) { return "hold for " + with_unit(time_s, "s"); }

std::string Rig::to(Vec to_m, double speed_mps) const {
  return "move to " + place(rotation_.turn(to_m)) + " at " + with_unit(speed_mps, "m/s");
}

RigRun Rig::run(const Solid& solid, Vec start_m, const std::vector<std::string>& script,
                Contact contact, const Lines& settings) const {
  Lines lines = {{"mass", with_unit(kMass_kg, "kg")},
                 {"viscous_friction", "0.5 N*s/m"},
                 {"coulomb_friction", "0 N"},
                 {"encoder_quantum", "10 um"},
                 {"hand_stiffness", with_unit(grip_N_per_m, "N/m")},
                 {"hand_damping", "4 N*s/m"},
                 {"tool_radius", with_unit(radius_m, "m")},
                 {"contact_stiffness", with_unit(stiffness_N_per_m, "N/m")},
                 {"contact_damping", "1 N*s/m"}};
  for (const auto& [key, value] : settings) {
    const auto found = std::find_if(lines.begin(), lines.end(), [&, name = key](const auto& line) {
      return line.first == name;
    });
    if (found == lines.end())
      lines.emplace_back(key, value);
    else
      found->second = value;
  }
  std::string text =
      "asset solid.fta\nrate 1000 Hz\nstart " + place(rotation_.turn(start_m)) + "\n";
  for (const auto& [key, value] : lines) text += key + " " + value + "\n";
  for (const std::string& statement : script) text += statement + "\n";
  Scenario scenario = read_scenario("bench", text, {}, parameter_rows());
  complete(scenario);
  const Session session(folder_.write("solid.fta", asset_of(solid, rotation_)), {}, contact);
  const Environment environment;
  Simulation simulation(scenario, session.tick(), environment);
  RigRun run;
  const auto back = [&](Vec v) { return rotation_.turn_back(v); };
  for (RunTick tick; simulation.next(tick);) {
    const record::TickOutput& out = tick.record.output;
    run.push_back({back(wide(out.force_N)), back(wide(out.motor_N)), back(tick.device_m),
                   back(wide(out.position_m)), back(wide(out.proxy_m)), back(tick.target_m),
                   static_cast<double>(out.penetration_m),
                   tick.hand_J - 0.5 * kMass_kg * dot(tick.device_mps, tick.device_mps), out.faults,
                   motors_are_on(out)});
  }
  return run;
}

Vec mean_force_N(const RigRun& run, size_t ticks) {
  Vec sum_N;
  for (size_t i = run.size() - std::min(ticks, run.size()); i < run.size(); ++i)
    sum_N = sum_N + run[i].force_N;
  return sum_N * (1.0 / static_cast<double>(std::min(ticks, run.size())));
}

std::vector<ScoredTick> scored(const RigRun& run) {
  std::vector<ScoredTick> ticks;
  for (const RigTick& tick : run)
    ticks.push_back({tick.force_N, tick.motor_N, tick.device_m, tick.depth_m, tick.is_on});
  return ticks;
}

}  // namespace firmtouch::host_sim
