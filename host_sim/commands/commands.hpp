#pragma once
#include <stdexcept>
#include <string>
#include <vector>

namespace firmtouch::host_sim {

/// Wrong command line.
struct Usage : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Runs `run ...`, `replay ...`, `record ...`, `scenario ...`, `z-width ...` or
/// `--help`.
/// Result: the exit code. Throws Usage or Refused.
int run_command(const std::vector<std::string>& words);

int run_scenario(const std::vector<std::string>& words);
int replay_log(const std::vector<std::string>& words);
int record_live(const std::vector<std::string>& words);
int make_scenario(const std::vector<std::string>& words);
int print_z_width(const std::vector<std::string>& words);

/// Parses the arguments of a command: `--name VALUE`, `--name=VALUE`, and operands.
class Options {
 public:
  /// `with_value`: the known options. Throws Usage for an unknown one or a missing value.
  Options(const std::vector<std::string>& words, const std::vector<std::string>& with_value);
  /// The last value given; empty if there is none.
  std::string value(const std::string& name) const;
  std::vector<std::string> values(const std::string& name) const;
  bool help() const { return help_; }
  const std::vector<std::string>& operands() const { return operands_; }

 private:
  std::vector<std::pair<std::string, std::string>> given_;
  std::vector<std::string> operands_;
  bool help_ = false;
};

}  // namespace firmtouch::host_sim
