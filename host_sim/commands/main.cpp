// firmtouch-sim. Exit codes: 0 done; 1 it ran and the answer is no; 2 usage; 3 bad input.
#include <csignal>

#include "cli/program.hpp"
#include "host_sim/commands/commands.hpp"

int main(int argc, char** argv) {
  using namespace firmtouch::host_sim;
  std::signal(SIGPIPE, SIG_IGN);  // a closed link is an error message, not a signal
  return firmtouch::cli::run_program(
      {"firmtouch-sim",
       "Runs a controller with a simulated device and a simulated hand.",
       {run_command(), replay_command(), record_command(), live_command(), scenario_command(),
        view_command(), score_command(), bench_command(), study_command(), z_width_command(),
        hands_command(), device_command(), home_command(), compare_command(), sweep_command(),
        merge_command(), export_command(), crash_command(), load_command()}},
      argc, argv);
}
