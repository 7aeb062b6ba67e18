#include <unistd.h>

#include <filesystem>

#include "cli/commands.hpp"
#include "cli/program.hpp"

namespace {

// `firmtouch bench feel ...`: firmtouch-sim beside this program becomes this process. Returns where
// it is none of its benches, or it is not there.
void become_simulator(char** argv, const std::string& command, const std::string& name) {
  if (command != "bench" || !firmtouch::cli::is_bench_of_simulator(name)) return;
  std::error_code error;
  std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) self = argv[0];
  const std::string simulator = self.replace_filename("firmtouch-sim").string();
  execv(simulator.c_str(), argv);
}

}  // namespace

int main(int argc, char** argv) {
  using namespace firmtouch::cli;
  if (argc > 2) become_simulator(argv, argv[1], argv[2]);
  return run_program(
      {"firmtouch",
       "Bakes surfaces and paths into assets that a controller touches in fixed memory.",
       {make_command(), bake_command(), info_command(), query_command(), log_command(),
        bench_command(), voxelize_command(), hull_command(), mend_command(), calibrate_command(),
        plan_command()}},
      argc, argv);
}
