#pragma once
#include "cli/arguments.hpp"

namespace firmtouch::cli {

// The commands: what each takes, and what it does (result: an exit code; a Failure ends it early).
const Command& make_command();
int run_make(const Arguments& arguments);

const Command& bake_command();
int run_bake(const Arguments& arguments);

const Command& info_command();
int run_info(const Arguments& arguments);

const Command& query_command();
int run_query(const Arguments& arguments);

const Command& mend_command();
int run_mend(const Arguments& arguments);

const Command& hull_command();
int run_hull(const Arguments& arguments);

const Command& bench_command();
int run_bench(const Arguments& arguments);

const Command& log_command();
int run_log(const Arguments& arguments);

const Command& voxelize_command();
int run_voxelize(const Arguments& arguments);

}  // namespace firmtouch::cli
