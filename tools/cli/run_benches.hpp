#pragma once
#include <vector>

#include "bench/bench.hpp"
#include "cli/arguments.hpp"

namespace firmtouch::cli {

/// Runs one bench of `all`, or all of them, on the models that the arguments name; without a name
/// it prints the list. Result: an exit code. Options: --peer, --bar, --figures, --json, --long.
/// The options that all of them take, and more.
std::vector<Option> options_of_benches(std::vector<Option> own);

int run_benches(const std::vector<bench::Bench>& all, const Arguments& arguments);

}  // namespace firmtouch::cli
