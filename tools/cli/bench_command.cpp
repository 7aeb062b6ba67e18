#include <algorithm>

#include "cli/commands.hpp"
#include "cli/failure.hpp"
#include "cli/queries.hpp"
#include "cli/run_benches.hpp"

namespace firmtouch::cli {
namespace {

// What reproduces papers and designs that lost is run by the lab.
constexpr const char* kOfTheLab[] = {"cells",  "grid",          "hulls",    "morris",
                                     "orders", "pseudonormals", "pyramids", "splines"};
// What needs the simulated device is run by the simulator.
constexpr const char* kOfTheSimulator[] = {"feel", "friction", "passivity"};

}  // namespace

bool is_bench_of_simulator(const std::string& name) {
  return std::find(std::begin(kOfTheSimulator), std::end(kOfTheSimulator), name) !=
         std::end(kOfTheSimulator);
}

Command bench_command() {
  return {
      {"bench", "[NAME|all] [MODEL...] [options]", 0, SIZE_MAX, run_bench},
      "Measures the bars of the project.",
      R"(Without NAME: the benches there are. Without MODEL: the demo's part. Times are of one
thread, in turn with the peer's in one run, medians of 5; only their ratio means
something on another machine. A peer is another program that answers the same queries:
    COMMAND closest|segment|polyline|spline FILE in.csv     prints `us_per_query X`
    COMMAND closest FILE in.csv --warm     the same; each query may use the last answer
feel, friction and passivity need the simulated device: firmtouch-sim, beside this
program, runs them, with its own options (firmtouch-sim bench --help).)",
      options_of_benches(
          {{"--isa", "LEVEL", "mesh queries with this instruction set (default: the fastest here)"},
           {"--ticks", "N", "touch: ticks a model (default: 200,000; --long: 20,000,000)"},
           {"--seed", "N", "touch: seed of its first ride (default: 0)"},
           {"--release", nullptr, "touch: 1,500 hands that leave with 20 work units a tick"}})};
}

int run_bench(const Arguments& arguments) {
  for (const std::string& name : arguments.positionals()) {
    if (is_bench_of_simulator(name))
      fail_usage("bench: '" + name + "' is run as `firmtouch-sim bench " + name + "`");
    if (name == "device") fail_usage("bench: devices are measured by `firmtouch-sim device NAME`");
    if (std::find(std::begin(kOfTheLab), std::end(kOfTheLab), name) == std::end(kOfTheLab)) break;
    fail_usage("bench: '" + name + "' is now run as `firmtouch-lab " + name +
               "`; build it with cmake --preset host -DFIRMTOUCH_LAB=ON");
  }
  choose_isa(arguments);
  return run_benches(bench::benches(), arguments);
}

}  // namespace firmtouch::cli
