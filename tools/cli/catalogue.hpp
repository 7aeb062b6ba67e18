#pragma once
#include "cli/arguments.hpp"

namespace firmtouch::cli {

/// `firmtouch bake --catalogue LIST -o RESULTS.csv`: bakes what each line says, on all cores, and
/// goes on where it ended. An input that is refused is a row of the results, and stops no other.
/// Result: exit code; kAnswerIsNo where one was refused. Fails (usage) where a line contradicts
/// itself or another one.
int bake_catalogue(const Arguments& arguments);

}  // namespace firmtouch::cli
