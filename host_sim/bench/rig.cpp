#include "host_sim/bench/rig.hpp"

#include <algorithm>
#include <cstdio>

#include "device/machines.hpp"
#include "host_sim/device/linkage_body.hpp"
#include "surface/random.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kMass_kg = 0.075;

// Energy that the hand gets back from the device alone: of its motion, its stops, and of its weight
// and springs as far as the motors do not carry it.
class Stored {
 public:
  explicit Stored(bool is_carried) : is_carried_(is_carried) {}
  double next_J(const RunTick& tick, const EnergyBook* linkage, bool is_ramped_in) {
    if (linkage == nullptr) return 0.5 * kMass_kg * dot(tick.device_mps, tick.device_mps);
    if (is_carried_ && is_ramped_in) carried_J_ += linkage->weight_J - weight_J_;
    weight_J_ = linkage->weight_J;
    return linkage->stored_J - carried_J_;
  }

 private:
  bool is_carried_;
  double weight_J_ = 0, carried_J_ = 0;
};

double wide(float a) { return static_cast<double>(a); }

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

Rig::Rig(uint64_t its_seed, const std::string& machine) : seed(its_seed), machine_(machine) {
  tools::Random random(seed);
  const auto draw = [&](double low, double high) { return random.between(low, high); };
  if (!machine.empty()) {
    linkage_ = tools::read_device(machine, tools::read_device_text(machine));
    linkage_->are_walls_forced = true;  // the observer of energy is what a study tests
    linkage_->is_homed = linkage_->has_index_pulses;
    JointMotion at;
    for (uint32_t k = 0; k < linkage_->joints.joints; ++k) {
      const device::JointSetting& joint = linkage_->joints.joint[k];
      const double low = wide(joint.low_rad), high = wide(joint.high_rad);
      at.angle_rad[k] = low + (high - low) * draw(0.3, 0.7);
    }
    check_inertia(LinkageBody(*linkage_, at), machine);
    tip_m_ = points_of(*linkage_, at).tip.at_m;
  }
  if (seed == 0) return;
  const double x = draw(-1, 1), y = draw(-1, 1), z = draw(-1, 1);
  rotation_ = Rotation({x, y, z}, draw(0.2, 3));
  if (linkage_ && linkage_->joints.joints == 2)  // z in the plane of the linkage, y across it
    rotation_ =
        Rotation({0, 0, 1}, draw(-3.2, 3.2)).after(Rotation({1, 0, 0}, -1.5707963267948966));
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

std::string Rig::to(Vec to_m, double speed_mps) {
  return "move to " + place(to_m) + " at " + with_unit(speed_mps, "m/s");
}

std::string Rig::statements(Vec start_m, Vec origin_m, const Lines& settings) const {
  Lines lines = {{"hand_stiffness", with_unit(grip_N_per_m, "N/m")},
                 {"hand_damping", "4 N*s/m"},
                 {"tool_radius", with_unit(radius_m, "m")},
                 {"contact_stiffness", with_unit(stiffness_N_per_m, "N/m")},
                 {"contact_damping", "1 N*s/m"}};
  if (linkage_) {
    lines.emplace_back("device", machine_);
    lines.emplace_back("device_damping", "0 N*s/m");
    lines.emplace_back("scene_x", with_unit(origin_m.x, "m"));
    lines.emplace_back("scene_y", with_unit(origin_m.y, "m"));
    lines.emplace_back("scene_z", with_unit(origin_m.z, "m"));
  } else {
    lines.emplace_back("mass", with_unit(kMass_kg, "kg"));
    lines.emplace_back("viscous_friction", "0.5 N*s/m");
    lines.emplace_back("coulomb_friction", "0 N");
    lines.emplace_back("encoder_quantum", "10 um");
  }
  for (const auto& [key, value] : settings) {
    const auto found = std::find_if(lines.begin(), lines.end(), [&, name = key](const auto& line) {
      return line.first == name;
    });
    if (found == lines.end())
      lines.emplace_back(key, value);
    else
      found->second = value;
  }
  std::string text = "asset solid.fta\nrate 1000 Hz\nstart " + place(start_m) + "\n";
  for (const auto& [key, value] : lines) text += key + " " + value + "\n";
  return text;
}

std::string Rig::bake(const Solid& solid) const {
  return folder_.write("solid.fta", asset_of(solid, rotation_, linkage_ ? &*linkage_ : nullptr));
}

RigRun Rig::run(const Solid& solid, Vec start_m, const std::vector<std::string>& script,
                Contact contact, const Lines& settings) const {
  const Session session(bake(solid), {}, contact);
  return run(session.tick(), start_m, script, settings);
}

RigRun Rig::run_guided(const std::vector<Vec>& points_m, Vec start_m,
                       const std::vector<std::string>& script, const Lines& settings,
                       const Solid* solid) const {
  const std::string bytes = guide_of(points_m, rotation_, linkage_ ? &*linkage_ : nullptr, solid);
  const Session session(folder_.write("solid.fta", bytes));
  return run(session.tick(), start_m, script, settings);
}

Vec Rig::origin_m(Vec start_m) const { return linkage_ ? tip_m_ - rotation_.turn(start_m) : Vec{}; }

Scenario Rig::scenario(Vec start_m, const std::vector<std::string>& script,
                       const Lines& settings) const {
  const Vec origin_m = this->origin_m(start_m);
  std::string text = statements(start_m, origin_m, settings);
  for (const std::string& statement : script) text += statement + "\n";
  Scenario scenario = read_scenario("bench", text, {}, parameter_rows());
  complete(scenario);
  scenario.linkage = linkage_;
  scenario.start_m = rotation_.turn(scenario.start_m) + origin_m;
  for (Move& move : scenario.moves) move.to_m = rotation_.turn(move.to_m) + origin_m;
  return scenario;
}

RigRun Rig::run(const Tick& controller, Vec start_m, const std::vector<std::string>& script,
                const Lines& settings) const {
  const Scenario scenario = this->scenario(start_m, script, settings);
  const Vec origin_m = this->origin_m(start_m);
  const Environment environment;
  Simulation simulation(scenario, controller, environment);
  Stored stored(linkage_ && linkage_->carried_share > 0);
  RigRun run;
  const auto back = [&](Vec v) { return rotation_.turn_back(v); };
  const auto place_of = [&](Vec at_m) { return back(at_m - origin_m); };
  for (RunTick tick; simulation.next(tick);) {
    const record::TickOutput& out = tick.record.output;
    const bool is_ramped_in =
        (out.state & record::kStateServoMask) == static_cast<uint32_t>(servo::Mode::kOn);
    run.push_back({back(wide(out.force_N)), back(wide(out.motor_N)), place_of(tick.device_m),
                   place_of(wide(out.position_m)), place_of(wide(out.proxy_m)),
                   place_of(tick.target_m), static_cast<double>(out.penetration_m),
                   tick.hand_J - stored.next_J(tick, simulation.energy(), is_ramped_in), out.faults,
                   motors_are_on(out), is_ramped_in, (out.state & record::kStateOnGuide) != 0});
  }
  return run;
}

Vec mean_force_N(const RigRun& run, size_t ticks) {
  Vec sum_N;
  for (size_t i = run.size() - std::min(ticks, run.size()); i < run.size(); ++i)
    sum_N = sum_N + run[i].force_N;
  return sum_N * (1.0 / static_cast<double>(std::min(ticks, run.size())));
}

std::vector<ScoredTick> scored(const RigRun& run, double stiffness_N_per_m) {
  std::vector<ScoredTick> ticks;
  for (const RigTick& tick : run) {
    const double turn = ticks.empty() ? 0 : turn_rad(ticks.back().contact_N, tick.force_N);
    ticks.push_back({tick.force_N, tick.force_N, turn, tick.device_m, tick.depth_m,
                     stiffness_N_per_m, tick.is_on});
  }
  return ticks;
}

}  // namespace firmtouch::host_sim
