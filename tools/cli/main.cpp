#include <cstdio>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "cli/failure.hpp"
#include "cli/program.hpp"
#include "cli/version.hpp"

namespace firmtouch::cli {
namespace {

struct Entry {
  const Command& (*command)();
  int (*run)(const Arguments&);
};

constexpr Entry kEntries[] = {
    {make_command, run_make},           {bake_command, run_bake}, {info_command, run_info},
    {query_command, run_query},         {log_command, run_log},   {bench_command, run_bench},
    {voxelize_command, run_voxelize},   {hull_command, run_hull}, {mend_command, run_mend},
    {calibrate_command, run_calibrate}, {plan_command, run_plan}};

std::string usage() {
  std::string text =
      "usage: firmtouch COMMAND ...\n"
      "Bakes surfaces and paths into assets that a controller touches in fixed memory.\n\n";
  for (const Entry& entry : kEntries) {
    std::string line = std::string("  ") + entry.command().name;
    line.resize(12, ' ');
    text += line + entry.command().summary + "\n";
  }
  return text +
         "\nfirmtouch COMMAND --help says more. Exit codes: 0 done, 1 the answer is no, 2 usage, 3 "
         "bad input.\n";
}

int run(const std::vector<std::string>& words) {
  if (words.empty()) {
    std::fputs(usage().c_str(), stderr);
    return kUsage;
  }
  if (words[0] == "--help" || words[0] == "-h" || words[0] == "help") {
    std::fputs(usage().c_str(), stdout);
    return kDone;
  }
  if (words[0] == "--version") {
    std::puts(kToolVersion);
    return kDone;
  }
  for (const Entry& entry : kEntries) {
    const Command& command = entry.command();
    if (words[0] != command.name) continue;
    const Arguments arguments(command, {words.begin() + 1, words.end()});
    if (!arguments.wants_help()) return entry.run(arguments);
    std::fputs(help_of(command).c_str(), stdout);
    return kDone;
  }
  fail_usage("'" + words[0] + "' is no command (see firmtouch --help)");
}

}  // namespace
}  // namespace firmtouch::cli

int main(int argc, char** argv) {
  return firmtouch::cli::run_program("firmtouch", firmtouch::cli::run, argc, argv);
}
