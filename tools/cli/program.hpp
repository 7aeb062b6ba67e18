#pragma once
#include <vector>

#include "cli/arguments.hpp"

namespace firmtouch::cli {

struct Program {
  const char* name;
  const char* summary;
  std::vector<Command> commands;  // or one without a name, which takes all words
};

/// Runs the command that the first word names, --help or --version, and returns the exit code. A
/// Failure or an exception is printed behind the program's name; a standard output that cannot be
/// written is bad input.
int run_program(const Program& program, int argc, char** argv);

}  // namespace firmtouch::cli
