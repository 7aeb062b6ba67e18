#include "cli/program.hpp"
#include "cli/run_benches.hpp"
#include "lab/trials.hpp"

namespace firmtouch::lab {
namespace {

cli::Command command() {
  return {{"", "[NAME|all] [MODEL...] [options]", 0, SIZE_MAX,
           [](const cli::Arguments& arguments) { return cli::run_benches(trials(), arguments); }},
          "Reproduces tables and figures of the papers, and measures designs that lost.",
          R"(Without NAME: the list. Without MODEL: the demo's part. tools/lab/JOURNAL.md says what
came of each trial. A peer is another program that answers the same queries, as for
firmtouch bench.)",
          cli::options_of_benches(
              {{"--figures", "FOLDER", "where `pictures` draws (default: the current folder)"}})};
}

}  // namespace
}  // namespace firmtouch::lab

int main(int argc, char** argv) {
  return firmtouch::cli::run_program({"firmtouch-lab", "", {firmtouch::lab::command()}}, argc,
                                     argv);
}
