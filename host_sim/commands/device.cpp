#include <cmath>
#include <cstdio>
#include <string>

#include "device/device_file.hpp"
#include "device/machines.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/device/firmware_check.hpp"
#include "host_sim/device/transmission_check.hpp"
#include "host_sim/device/workspace.hpp"
#include "host_sim/trace/log.hpp"
#include "json/json.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kDegrees = 57.295779513082323;
constexpr uint32_t kSteps[] = {0, 0, 400, 40};  // of a joint, by the number of joints

double percent(uint32_t part, const Workspace& of) { return 100.0 * part / of.poses; }

constexpr uint32_t kCheckedPoses = 1000000;

const char* verdict(double error, double goal) { return error <= goal ? "" : "  NOT MET"; }

void print_check(const FirmwareCheck& check) {
  std::printf("poses of the check against the simulation  %u\n", check.poses);
  if (std::isfinite(check.inverse_m))
    std::printf("inverse of forward kinematics              within %.2g m (goal %.2g)%s\n",
                check.inverse_m, kMaxInverse_m, verdict(check.inverse_m, kMaxInverse_m));
  else
    std::printf("inverse of forward kinematics              not found at a pose  NOT MET\n");
  std::printf("Jacobian against differences               within %.2g (goal %.2g)%s\n",
              check.jacobian, kMaxJacobianError, verdict(check.jacobian, kMaxJacobianError));
  std::printf("force at the tip, counts to torques        within %.2g %% (goal %.2g)%s\n",
              check.force * 100, kMaxForceError * 100, verdict(check.force, kMaxForceError));
  if (check.force > kMaxForceError)
    std::printf(
        "    a count turns the force so far: encoders with more counts, or full_from above "
        "%.2g, mend it\n",
        check.force_condition);
  std::printf("weight carried, largest torque %.3g N m   within %.2g %% (goal %.2g)%s\n",
              check.heaviest_Nm, check.weight * 100, kMaxWeightError * 100,
              verdict(check.weight, kMaxWeightError));
}

void print_row(const char* what, const char* unit, double scale, const Predicted& it, double goal) {
  if (!(it.closed_form > 0)) return;
  if (!std::isfinite(it.closed_form)) {
    std::printf("%-43sinfinite: at a pose the links lock, or a rotor is too light  NOT MET\n",
                what);
    return;
  }
  std::printf("%-43s%.5g %s, closed form %.5g, off %.2g %% (goal %.2g)%s\n", what,
              it.measured * scale, unit, it.closed_form * scale, it.error() * 100, goal * 100,
              verdict(it.error(), goal));
}

void print_transmission(const TransmissionCheck& check) {
  print_row("first resonance of the cables", "Hz", 1, check.resonance_Hz, kMaxResonanceError);
  print_row("limit cycle of the backlash", "Hz", 1, check.cycle_Hz, kMaxCycleError);
  print_row("amplitude of that cycle", "mrad", 1e3, check.cycle_rad, kMaxCycleError);
}

std::string machines() {
  std::string names;
  for (const std::string& name : tools::machine_names())
    names += (names.empty() ? "" : ", ") + name;
  return "Machines: " + names + "\n";
}

void print_assumed(const std::string& text) {
  std::string keys;
  for (const std::string& key : tools::assumed_keys(text)) keys += (keys.empty() ? "" : ", ") + key;
  if (!keys.empty()) std::printf("assumed, without a source: %s\n", keys.c_str());
}

bool has_inertia(const Workspace& space) { return space.least_mass_kg > 0 && space.massless == 0; }

void print_space(const Workspace& space, uint32_t joints) {
  const uint32_t none = space.poses - space.with_whole_force - space.with_faded_force;
  std::printf("poses on a grid over the joints' ranges    %u\n", space.poses);
  std::printf("not reachable                              %.2f %%\n",
              percent(space.poses - space.reachable, space));
  std::printf("whole, faded and no force                  %.2f, %.2f, %.2f %%\n",
              percent(space.with_whole_force, space), percent(space.with_faded_force, space),
              percent(none, space));
  if (space.reachable > 0)
    std::printf("tip, x y z from and to, mm                 %.1f %.1f %.1f   %.1f %.1f %.1f\n",
                space.low_m.x * 1e3, space.low_m.y * 1e3, space.low_m.z * 1e3, space.high_m.x * 1e3,
                space.high_m.y * 1e3, space.high_m.z * 1e3);
  if (space.with_whole_force > 0)
    std::printf(
        "force in every direction, with whole force %.3g N\n"
        "longest motion of the tip by a count       %.3g um\n",
        space.least_force_N, space.count_m * 1e6);
  if (space.lasting_force_N < space.least_force_N)
    std::printf("force in every direction, all motors hot   %.3g N\n", space.lasting_force_N);
  if (has_inertia(space))
    std::printf(
        "least mass of the tip                      %.3g g\n"
        "stiffest wall within 1 mJ, at 1 kHz         %.0f N/m, if it is stable: firmtouch-sim "
        "z-width\n",
        space.least_mass_kg * 1e3, stiffest_wall_N_per_m(space, 1e-3));
  else if (space.with_whole_force > 0)
    std::printf(
        "inertia is not positive definite in        %u poses: its stiffest wall and its cables are "
        "not checked,\nand no run can simulate it: give each joint a rotor_ or its links masses\n",
        space.massless);
  std::printf("least reciprocal condition                 %.4f at", space.worst_condition);
  for (uint32_t k = 0; k < joints; ++k) std::printf(" %.1f", space.worst_at_rad[k] * kDegrees);
  std::printf(" deg\n%s\n", is_free_of_singularities(space)
                                ? "no singularity within the ranges"
                                : "the ranges contain a singularity, or poses that the links "
                                  "do not reach: narrow low_ and high_");
}

bool is_met(const Workspace& space, const FirmwareCheck& check, const TransmissionCheck& cables) {
  return is_free_of_singularities(space) && has_inertia(space) && is_good(check) && is_good(cables);
}

std::string json_of(const Workspace& space, const FirmwareCheck& check,
                    const TransmissionCheck& cables) {
  const auto point = [](const Vec& v) {
    const double values[] = {v.x, v.y, v.z};
    return tools::json_list(values, [](double value) { return tools::json_number(value); });
  };
  tools::Json all;
  all.add("poses", uint64_t{space.poses}).add("reachable", uint64_t{space.reachable});
  all.add("with_whole_force", uint64_t{space.with_whole_force});
  all.add("with_faded_force", uint64_t{space.with_faded_force});
  all.add("low_m", point(space.low_m)).add("high_m", point(space.high_m));
  all.add("least_force_N", space.least_force_N).add("lasting_force_N", space.lasting_force_N);
  all.add("count_m", space.count_m);
  all.add("has_inertia", has_inertia(space)).add("least_mass_kg", space.least_mass_kg);
  if (has_inertia(space)) all.add("stiffest_wall_N_per_m", stiffest_wall_N_per_m(space, 1e-3));
  all.add("least_condition", space.worst_condition);
  all.add("has_singularity", !is_free_of_singularities(space));
  all.add("checked_poses", uint64_t{check.poses}).add("inverse_error_m", check.inverse_m);
  all.add("force_error", check.force).add("weight_error", check.weight);
  all.add("jacobian_error", check.jacobian);
  all.add("resonance_error", cables.resonance_Hz.error());
  all.add("cycle_error", cables.cycle_Hz.error());
  all.add("cycle_size_error", cables.cycle_rad.error());
  return all.add("is_met", is_met(space, check, cables)).object() + "\n";
}

int print_device(const cli::Arguments& options) {
  const std::string path = options.positionals()[0];
  const std::string text = tools::read_device_text(path);
  if (options.has("--print")) return std::fputs(text.c_str(), stdout) < 0 ? 3 : 0;
  const LinkageDevice device = tools::read_device(path, text);
  const Workspace space = workspace_of(device, kSteps[device.joints.joints]);
  const bool is_text = !options.has("--json");
  if (is_text) print_space(space, device.joints.joints);  // before the check, which takes a while
  const FirmwareCheck check =
      check_firmware(device, static_cast<uint32_t>(options.number("--poses", kCheckedPoses, 1)));
  LinkageDevice sprung = device;
  const bool is_assumed = assume_cables(sprung);
  const TransmissionCheck cables = check_transmission(sprung);
  if (is_text) {
    print_check(check);
    if (is_assumed) std::printf("rigid transmissions; for the next rows cables are assumed\n");
    print_transmission(cables);
    print_assumed(text);
  } else {
    std::fputs(json_of(space, check, cables).c_str(), stdout);
  }
  return is_met(space, check, cables) ? 0 : 1;
}

}  // namespace

cli::Command device_command() {
  const std::string details =
      "FILE begins with `linkage five_bar`, `linkage serial_arm [2|3]` or `linkage delta`; then "
      "lines KEY VALUE UNIT.\n# begins a comment. Frames, angles and lengths: "
      "firmware/firmtouch/device/five_bar.hpp, serial_arm.hpp, delta.hpp.\nKeys, with *: must be "
      "given; in brackets: the value if not given. Further joints and links: _1, _2 as _0.\n"
      "Other units: mm cm um in, deg, deg/s, counts/turn, g, g*cm2, mN*m, mN*m/A, mA, mN*m*s/rad, "
      "mN*m/rad, "
      "ms.\n" +
      tools::device_file_help() +
      "zero_0: angle at a count of 0. low_0, high_0: range. walls forced: walls stiffer than "
      "stable are enabled.\nfull_from, gone_at: reciprocal condition from which the force is "
      "whole, and at which it is gone.\ntorque_rise: least time from 0 to max_torque_0. "
      "carried_share: of max_torque_0, for the weight less spring_0 (relaxed_0 - "
      "angle) and friction_share of coulomb_0,\nfaded where the joint is slower than "
      "friction_fade. "
      "max_speed: a faster step of an encoder is "
      "rejected. home_torque_0: 0.3 of max_torque_0 if not given.\nhome_margin: by which the "
      "travel may miss the range. index_0: angle of an index pulse.\nsecond_within: by which a "
      "joint's two encoders may differ. continuous_torque_0: of a hot motor (I squared "
      "t).\nmax_current_0, continuous_current_0 with torque_constant_0 (at the joint): for those "
      "torques. winding_rise_0: at the\ncontinuous torque. magnet_rise_0: of the magnets, then; "
      "they follow by magnet_time_0.\ncable_0: 0 is rigid. poles_0: periods of "
      "ripple_0 and cogging_0 in a turn.\nbreakaway_0: dry friction at rest; at a rate w it is "
      "coulomb_0 + (breakaway_0 - coulomb_0) exp(-(w / stribeck_speed_0)^2).\n"
      "encoder_noise_0: standard deviation in counts.\nCentre and inertia "
      "of a link are "
      "those of an even rod if not given.\n" +
      machines() +
      "Exit code 1: a pose of the ranges is not reachable, singular, beyond the fade, or without "
      "inertia; or a figure misses its goal.\n";
  return {{"device", "FILE|MACHINE [options]", 1, 1, print_device},
          "checks a linkage's file, prints its workspace, and compares the firmware with its "
          "simulation",
          details,
          {{"--poses", "N", "of the check against the simulation (default 1000000)"},
           {"--print", nullptr, "the device file of a machine, to bake or to change"},
           {"--json", nullptr, "the workspace and the check as JSON"}}};
}

}  // namespace firmtouch::host_sim
