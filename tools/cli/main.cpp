#include "cli/commands.hpp"
#include "cli/program.hpp"

int main(int argc, char** argv) {
  using namespace firmtouch::cli;
  return run_program(
      {"firmtouch",
       "Bakes surfaces and paths into assets that a controller touches in fixed memory.",
       {make_command(), bake_command(), info_command(), query_command(), log_command(),
        bench_command(), voxelize_command(), hull_command(), mend_command(), calibrate_command(),
        plan_command()}},
      argc, argv);
}
