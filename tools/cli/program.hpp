#pragma once
#include <string>
#include <vector>

namespace firmtouch::cli {

/// Runs a program on its words and returns its exit code. A Failure or an exception is printed
/// behind the program's name; a standard output that cannot be written is bad input.
int run_program(const char* name, int (*run)(const std::vector<std::string>& words), int argc,
                char** argv);

}  // namespace firmtouch::cli
