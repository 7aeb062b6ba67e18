// firmtouch-sim. Exit codes: 0 done; 1 it ran and the answer is no; 2 usage; 3 bad input.
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>

#include "host_sim/commands/commands.hpp"
#include "host_sim/scenario/scenario.hpp"

int main(int argc, char** argv) {
  using namespace firmtouch::host_sim;
  std::signal(SIGPIPE, SIG_IGN);  // a closed link is an error message, not a signal
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    const int code = run_command(words);
    // A full disk or a closed pipe must not pass for success.
    if (std::cout.flush() && std::fflush(stdout) == 0) return code;
    std::cerr << "firmtouch-sim: standard output: cannot be written\n";
    return 3;
  } catch (const Usage& usage) {
    std::cerr << "firmtouch-sim: " << usage.what() << "\n";
    return 2;
  } catch (const Refused& refused) {
    std::cerr << "firmtouch-sim: " << refused.what() << "\n";
    return 3;
  } catch (const std::bad_alloc&) {
    std::cerr << "firmtouch-sim: out of memory; shorten the run\n";
    return 3;
  } catch (const std::exception& error) {
    std::cerr << "firmtouch-sim: " << error.what() << "\n";
    return 3;
  }
}
