#pragma once
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/report.hpp"

namespace firmtouch::host_sim {

/// Wrong command line.
struct Usage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One option of a command. `value`: its value's name in the help; nullptr for a flag.
struct Option {
  const char* name;
  const char* value;
  const char* help;
};

class Options;

struct Command {
  const char* name;
  const char* usage;    // the rest of the usage line
  const char* summary;  // one line
  const char* details;  // behind the options in --help, or ""
  std::vector<Option> options;
  int (*run)(const Options& options);  // result: the exit code
};

/// Runs `run ...`, `replay ...` and the other commands, `--help` or `--version`.
/// Result: the exit code. Throws Usage or Refused.
int run_command(const std::vector<std::string>& words);

/// As `firmtouch COMMAND --help` is laid out.
std::string help_of(const Command& command);

/// Parses the arguments of a command: `--name VALUE`, `--name=VALUE`, flags, and operands.
class Options {
 public:
  /// Throws Usage for an unknown option or a missing value.
  Options(const Command& command, const std::vector<std::string>& words);
  bool has(const std::string& name) const;
  /// The last value given; empty if there is none.
  std::string value(const std::string& name) const;
  std::vector<std::string> values(const std::string& name) const;
  /// A number of at least `least`; `otherwise` if the option is not given. Throws Usage.
  double number(const std::string& name, double otherwise, double least) const;
  bool help() const { return help_; }
  const std::vector<std::string>& words() const { return words_; }
  const std::vector<std::string>& operands() const { return operands_; }
  /// The only operand. Throws Usage if there is another number of them.
  const std::string& operand(const std::string& what) const;
  /// Throws Usage with the command's name.
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  std::string command_;
  std::vector<std::string> words_;
  std::vector<std::pair<std::string, std::string>> given_;
  std::vector<std::string> operands_;
  bool help_ = false;
};

/// Result: the exit code, 1 where a bar is not met.
int print_report(const bench::Report& report, const std::string& name, bool is_json);

// The commands.
const Command& run_command_line();
const Command& replay_command_line();
const Command& record_command_line();
const Command& crash_command_line();
const Command& live_command_line();
const Command& load_command_line();
const Command& view_command_line();
const Command& scenario_command_line();
const Command& score_command_line();
const Command& bench_command_line();
const Command& study_command_line();
const Command& z_width_command_line();
const Command& device_command_line();
const Command& home_command_line();
const Command& compare_command_line();
const Command& sweep_command_line();
const Command& merge_command_line();
const Command& export_command_line();

}  // namespace firmtouch::host_sim
