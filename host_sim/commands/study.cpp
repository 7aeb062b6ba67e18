#include "device/machines.hpp"
#include "host_sim/bench/passivity_study.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/commands/progress.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kHands = 200;

int run_study(const Options& options) {
  std::vector<std::string> machines = options.operands();
  if (machines.empty() || machines[0] != "passivity") options.refuse("studies are: passivity");
  machines.erase(machines.begin());
  if (machines.empty()) machines = tools::machine_names();
  bench::Report report;
  study_passivity(machines, static_cast<uint32_t>(options.number("--hands", kHands, 1)),
                  progress_bar("hands"), report);
  return print_report(report, "passivity", options.has("--json"));
}

}  // namespace

const Command& study_command_line() {
  static const Command command = {
      "study",
      "passivity [FILE|MACHINE ...] [options]",
      "energy that a linkage, its controller and contact give to hands",
      "Without FILE: every machine. Hands of 50 to 3,000 N/m go in and out of solids anywhere in "
      "the joints' ranges,\nwhile stiffness, damping, radius and friction change; "
      "then as many runs of a search for the worst.\nCounted is the hand's work, less what the "
      "linkage gives back. The same without the energy's limit shows that the\nbar can fail. Exit "
      "code 1 where a bar is not met.\n",
      {{"--hands", "N", "of each machine (default 200)"}, {"--json", nullptr, "for programs"}},
      run_study};
  return command;
}

}  // namespace firmtouch::host_sim
