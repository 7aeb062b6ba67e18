#include "cli/program.hpp"

#include <algorithm>
#include <cstdio>
#include <exception>
#include <new>

#include "cli/failure.hpp"
#include "cli/version.hpp"

namespace firmtouch::cli {
namespace {

std::string usage_of(const Program& program) {
  size_t column = 0;
  for (const Command& command : program.commands)
    column = std::max(column, std::string(command.name).size() + 4);
  std::string text =
      std::string("usage: ") + program.name + " COMMAND ...\n" + program.summary + "\n\n";
  for (const Command& command : program.commands) {
    std::string line = std::string("  ") + command.name;
    line.resize(column, ' ');
    text += line + command.summary + "\n";
  }
  return text + "\n" + program.name +
         " COMMAND --help says more. Exit codes: 0 done, 1 the answer is no, 2 usage, 3 bad "
         "input.\n";
}

int run(const Program& program, const Command& command, const std::vector<std::string>& words) {
  const Arguments arguments(command, words, program.name);
  if (!arguments.wants_help()) return command.run(arguments);
  std::fputs(help_of(command, program.name).c_str(), stdout);
  return kDone;
}

int run(const Program& program, const std::vector<std::string>& words) {
  if (program.commands[0].name[0] == 0) return run(program, program.commands[0], words);
  if (words.empty()) {
    std::fputs(usage_of(program).c_str(), stderr);
    return kUsage;
  }
  if (words[0] == "--help" || words[0] == "-h" || words[0] == "help") {
    std::fputs(usage_of(program).c_str(), stdout);
    return kDone;
  }
  if (words[0] == "--version") {
    std::printf("%s %s\n", program.name, kRelease);
    return kDone;
  }
  for (const Command& command : program.commands)
    if (words[0] == command.name) return run(program, command, {words.begin() + 1, words.end()});
  fail_usage("'" + words[0] + "' is no command (see " + program.name + " --help)");
}

}  // namespace

int run_program(const Program& program, int argc, char** argv) {
  try {
    const int code = run(program, {argv + 1, argv + argc});
    // A full disk or a closed pipe must not pass for success.
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    std::fprintf(stderr, "%s: standard output: cannot be written\n", program.name);
    return kBadInput;
  } catch (const Failure& failure) {
    std::fprintf(stderr, "%s: %s\n", program.name, failure.message.c_str());
    return failure.exit_code;
  } catch (const std::bad_alloc&) {
    std::fprintf(stderr,
                 "%s: not enough memory for this input: use fewer or smaller inputs at once\n",
                 program.name);
    return kBadInput;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s: %s\n", program.name, error.what());
    return kBadInput;
  }
}

}  // namespace firmtouch::cli
