#include <cstdio>
#include <string>

#include "device/machines.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/commands/progress.hpp"
#include "host_sim/device/homing_check.hpp"
#include "host_sim/device/linkage_body.hpp"
#include "json/json.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kRuns = 10000;

void print_tallies(const HomingTally (&tallies)[kHomingCases]) {
  std::printf("%-14s %6s %6s %6s %7s %10s %7s  %s\n", "case", "runs", "homed", "wrong", "counts",
              "slowest s", "torque", "faults");
  for (uint32_t i = 0; i < kHomingCases; ++i) {
    const HomingTally& tally = tallies[i];
    std::printf("%-14s %6u %6u %6u %7lld %10.3f %7.3f  %s\n", case_name(static_cast<HomingCase>(i)),
                tally.runs, tally.homed, tally.wrong, static_cast<long long>(tally.worst_counts),
                tally.slowest_s, tally.torque_share, causes(tally).c_str());
  }
}

std::string json_of(const HomingTally (&tallies)[kHomingCases]) {
  uint32_t which = 0;
  return tools::json_list(tallies, [&](const HomingTally& tally) {
    tools::Json row;
    row.add("case", tools::json_text(case_name(static_cast<HomingCase>(which++))));
    row.add("runs", uint64_t{tally.runs}).add("homed", uint64_t{tally.homed});
    row.add("wrong", uint64_t{tally.wrong});
    row.add("worst_counts", static_cast<double>(tally.worst_counts));
    row.add("slowest_s", tally.slowest_s).add("torque_share", tally.torque_share);
    return "\n  " + row.add("faults", tools::json_text(causes(tally))).object();
  });
}

int print_homing(const cli::Arguments& options) {
  const std::string path = options.positionals()[0];
  const tools::LinkageDevice device = tools::read_device(path, tools::read_device_text(path));
  check_inertia(LinkageBody(device, middle_of(device)), path);
  const uint32_t runs = static_cast<uint32_t>(options.number("--runs", kRuns, kHomingCases));
  HomingTally tallies[kHomingCases];
  const std::function<void(double)> progress = progress_bar("homing");
  for (uint32_t run = 0; run < runs; ++run) {
    const uint32_t which = run % kHomingCases;
    add(simulate_homing(device, static_cast<HomingCase>(which), run), tallies[which]);
    if (progress && run % 64 == 0) progress(static_cast<double>(run) / runs);
  }
  if (progress) progress(1);
  if (options.has("--json")) std::printf("%s\n", json_of(tallies).c_str());
  if (!options.has("--json")) print_tallies(tallies);
  uint32_t wrong = 0;
  for (const HomingTally& tally : tallies) wrong += tally.wrong;
  return wrong == 0 ? 0 : 1;
}

}  // namespace

cli::Command home_command() {
  return {
      {"home", "FILE|MACHINE [options]", 1, 1, print_homing},
      "homes a simulated linkage with the firmware, again and again, also where something is wrong",
      R"(Each run has its own start, stops of 50 to 5,000 N/m, index phase and raw counts, half
of them about the wrap. The torque is 1.6 times what holds the joint's weight, and at
least a fifth of its largest; the column shows what was applied, over that.
wrong: more than a count off, no end in 2 s, or above the homing torque. Exit code 1 if
there is one.)",
      {{"--runs", "N", "of all cases together (default 10000)"},
       {"--json", nullptr, "the table as JSON"}}};
}

}  // namespace firmtouch::host_sim
