#include "device/machines.hpp"
#include "host_sim/bench/failure_study.hpp"
#include "host_sim/bench/passivity_study.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/commands/progress.hpp"
#include "host_sim/plant/failure.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kHands = 200, kEvery = 97;

// That of --only; empty: all.
std::string failure_of(const cli::Arguments& options) {
  if (!options.has("--only")) return "";
  std::vector<std::string> names;
  for (uint32_t i = 0; i < kFailureModes; ++i)
    names.emplace_back(failure_name(static_cast<FailureMode>(i)));
  return options.choice("--only", names[0], names);
}

int run_study(const cli::Arguments& options) {
  std::vector<std::string> machines = options.positionals();
  const std::string name = machines.empty() ? "" : machines[0];
  if (name != "passivity" && name != "failures") options.refuse("studies are: passivity, failures");
  machines.erase(machines.begin());
  if (machines.empty()) machines = tools::machine_names();
  bench::Report report;
  if (name == "passivity")
    study_passivity(machines, static_cast<uint32_t>(options.number("--hands", kHands, 1)),
                    progress_bar("hands"), report);
  else
    study_failures(machines, static_cast<uint32_t>(options.number("--every", kEvery, 1)),
                   failure_of(options), progress_bar("failures"), report);
  return print_report(report, name, options.has("--json"));
}

}  // namespace

cli::Command study_command() {
  return {{"study", "passivity|failures [FILE|MACHINE ...] [options]", 1, SIZE_MAX, run_study},
          "what linkages do to hands: energy that contact and guides give, failures of the machine",
          R"(Without FILE: every machine. Exit code 1 where a bar is not met.
passivity: hands of 50 to 3,000 N/m go in and out of solids, and about guides, anywhere
in the joints' ranges, while stiffness, damping, radius, friction and tunnel change; then
as many runs of a search for the worst. Counted is the hand's work, less what the linkage
gives back. The same without the energy's limit shows that the bar can fail.
failures: encoders that stand, are lost, swapped, reversed or slip, motors that are
dead, reversed or hot, a broken link, each joint, at every Nth tick of six touches of
walls of 600 to 1,200 N/m at 1 kHz; before a homing and at every Nth tick of it. With
`home stops` and index pulses they fail behind a homing, and absent pulses are one more.
seen: a fault was latched within 150 ticks; ticks to it, from there to motors at rest,
the largest torque over the joint's, speed of the tip and work done on the hand: the
worst of all runs.)",
          {{"--hands", "N", "passivity: of each machine (default 200)"},
           {"--every", "N", "failures: 1 takes a quarter of an hour (default 97)"},
           {"--only", "FAILURE", "failures: as in `firmtouch-sim run --help`; none in homing"},
           {"--json", nullptr, "for programs"}}};
}

}  // namespace firmtouch::host_sim
