#include <cstdio>

#include "cli/failure.hpp"
#include "cli/program.hpp"
#include "cli/run_benches.hpp"
#include "lab/trials.hpp"

namespace firmtouch::lab {
namespace {

const cli::Command& command() {
  static const cli::Command command{
      "",
      "[NAME|all] [MODEL...] [options]",
      "Reproduces tables and figures of the papers, and measures designs that lost.",
      "Without NAME: the list. Without MODEL: the demo's part. tools/lab/JOURNAL.md says what came "
      "of\n"
      "each trial. A peer is another program that answers the same queries, as for firmtouch "
      "bench.",
      cli::options_of_benches(
          {"--figures", "FOLDER", "where `pictures` draws (default: the current folder)"}),
      0,
      SIZE_MAX,
      "firmtouch-lab"};
  return command;
}

int run(const std::vector<std::string>& words) {
  const cli::Arguments arguments(command(), words);
  if (!arguments.wants_help()) return cli::run_benches(trials(), arguments);
  std::fputs(cli::help_of(command()).c_str(), stdout);
  return cli::kDone;
}

}  // namespace
}  // namespace firmtouch::lab

int main(int argc, char** argv) {
  return firmtouch::cli::run_program("firmtouch-lab", firmtouch::lab::run, argc, argv);
}
