#include <cstdio>
#include <iostream>

#include "host_sim/bench/benches.hpp"
#include "host_sim/commands/commands.hpp"

namespace firmtouch::host_sim {
namespace {

int run_bench(const cli::Arguments& options) {
  if (options.positionals().empty()) {
    for (const bench::Bench& each : rig_benches())
      std::printf("  %-12s%s\n", each.name, each.summary);
    return 0;
  }
  const std::string name = options.positionals()[0];
  for (const bench::Bench& each : rig_benches()) {
    if (name != each.name) continue;
    bench::Options chosen;
    chosen.is_long = options.has("--long");
    bench::Report report;
    if (!options.has("--moving"))
      each.run(chosen, report);
    else if (each.run == run_contact_bench)
      run_moving_bench(chosen, report);
    else
      options.refuse("--moving is for feel");
    return print_report(report, name, options.has("--json"));
  }
  options.refuse("'" + name + "' is no bench; without a name it lists them");
}

}  // namespace

int print_report(const bench::Report& report, const std::string& name, bool is_json) {
  if (is_json)
    std::cout << "{\"benches\": [\n  {\"name\": \"" << name << "\",\n   "
              << bench::to_json_members(report) << "}\n]}\n";
  else
    std::cout << bench::to_text(report);
  return report.bars_not_met() == 0 ? 0 : 1;
}

cli::Command bench_command() {
  return {{"bench", "[NAME] [options]", 0, 1, run_bench},
          "measures the contact of a controller on the simulated device against closed forms",
          "Without NAME: the benches there are. Exit code 1 where a bar is not met.",
          {{"--long", nullptr, "the full sizes"},
           {"--moving", nullptr, "feel: a wall that rises through a held tool, and two that close"},
           {"--json", nullptr, "for programs"}}};
}

}  // namespace firmtouch::host_sim
