#pragma once
#include "cli/arguments.hpp"

namespace firmtouch::cli {

using MakeCommand = Command();
MakeCommand make_command, bake_command, info_command, query_command, mend_command, hull_command,
    bench_command, log_command, voxelize_command, calibrate_command, plan_command;

using Run = int(const Arguments& arguments);
Run run_make, run_bake, run_info, run_query, run_mend, run_hull, run_bench, run_log, run_voxelize,
    run_calibrate, run_plan;

/// Whether firmtouch-sim runs the bench: it needs the simulated device.
bool is_bench_of_simulator(const std::string& name);

}  // namespace firmtouch::cli
