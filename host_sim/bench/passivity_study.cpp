#include "host_sim/bench/passivity_study.hpp"

#include <algorithm>

#include "device/machines.hpp"
#include "host_sim/bench/passive_hands.hpp"
#include "host_sim/device/workspace.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kMaxGain_mJ = 1, kStiffest_N_per_m = 20000, kPeriod_s = 1e-3;
constexpr uint32_t kSteps[] = {0, 0, 100, 20};  // of a joint, by the number of joints
constexpr double kRows = 6;                     // of a machine
constexpr uint32_t kTries = 19;                 // of a start, beside itself

std::string remark_of(const HandsGain& gain) {
  return std::to_string(gain.touched) + " of " + std::to_string(gain.hands) + " touched, " +
         std::to_string(gain.faulted) + " faulted, " + std::to_string(gain.overdrawn) +
         " by energy; worst: " + gain.worst;
}

// Up to which the parameter should go on this machine.
double stiffest_of(const std::string& machine) {
  const LinkageDevice device = tools::read_device(machine, tools::read_device_text(machine));
  const Workspace space = workspace_of(device, kSteps[device.joints.joints]);
  return std::min(kStiffest_N_per_m, stiffest_wall_N_per_m(space, kPeriod_s));
}

}  // namespace

void study_passivity(const std::vector<std::string>& machines, uint32_t hands,
                     const std::function<void(double)>& progress, bench::Report& report) {
  const uint32_t starts = std::max(1u, hands / (kTries + 1));
  double done = 0;
  for (const std::string& machine : machines) {
    const auto said = [&](const char* what, const HandsGain& gain) {
      report.bar(what, machine, 1e3 * gain.worst_J, "mJ", kMaxGain_mJ, remark_of(gain));
      report.bar_at_least("hands that touched", machine, gain.touched, "", 0.8 * gain.hands);
      if (progress) progress(++done / (kRows * static_cast<double>(machines.size())));
    };
    const double stiffest_N_per_m = stiffest_of(machine);
    report.figure("stiffest wall within 1 mJ, at 1 kHz", machine, stiffest_N_per_m, "N/m");
    said("random hands: energy given", random_hands(machine, stiffest_N_per_m, hands, {}));
    said("hands with a mass: energy given", massive_hands(machine, stiffest_N_per_m, hands, {}));
    said("hands about a guide: energy given", guided_hands(machine, stiffest_N_per_m, hands, {}));
    said("worst hand found by hill climbing: energy given",
         worst_hand(machine, stiffest_N_per_m, Against::kPlate, starts, kTries, {}));
    said("worst hand about a guide found by hill climbing: energy given",
         worst_hand(machine, stiffest_N_per_m, Against::kGuide, starts, kTries,
                    {{"geometry_rate", "50 Hz"}}));
    const HandsGain without =
        random_hands(machine, kStiffest_N_per_m, hands, {{"energy_reservoir", "1000 J"}});
    report.bar_at_least("the same of random hands, not limited", machine, 1e3 * without.worst_J,
                        "mJ", kMaxGain_mJ, remark_of(without));
    if (progress) progress(++done / (kRows * static_cast<double>(machines.size())));
  }
}

}  // namespace firmtouch::host_sim
