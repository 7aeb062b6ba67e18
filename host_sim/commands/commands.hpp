#pragma once
#include <string>

#include "bench/report.hpp"
#include "cli/arguments.hpp"
#include "cli/failure.hpp"

namespace firmtouch::host_sim {

/// Result: the exit code, 1 where a bar is not met.
int print_report(const bench::Report& report, const std::string& name, bool is_json);

using MakeCommand = cli::Command();
MakeCommand run_command, replay_command, record_command, crash_command, live_command, load_command,
    view_command, scenario_command, score_command, bench_command, study_command, z_width_command,
    hands_command, device_command, home_command, compare_command, sweep_command, merge_command,
    export_command;

}  // namespace firmtouch::host_sim
