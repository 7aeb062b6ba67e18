#pragma once
#include <string>

namespace firmtouch::cli {

// Exit codes of every command.
constexpr int kDone = 0;
constexpr int kAnswerIsNo = 1;  // it ran, and the answer is no
constexpr int kUsage = 2;
constexpr int kBadInput = 3;  // a file that cannot be opened included

/// What ends a command early. The message names the file, the place, what is wrong and how to mend
/// it; main() prints it behind the program's name.
struct Failure {
  int exit_code;
  std::string message;
};

[[noreturn]] inline void fail_usage(const std::string& message) { throw Failure{kUsage, message}; }
[[noreturn]] inline void fail_input(const std::string& message) {
  throw Failure{kBadInput, message};
}

}  // namespace firmtouch::cli
