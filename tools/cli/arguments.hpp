#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace firmtouch::cli {

/// One option of a command. `value`: what stands for its value in the help; nullptr for a flag.
/// `help`: nullptr for an option of the plan that this version does not have yet, which is refused
/// by name.
struct Option {
  const char* name;
  const char* value;
  const char* help;
  bool may_repeat = false;
};

class Arguments;

/// What a command is called with, and what it then calls.
struct Call {
  const char* name;
  const char* usage;  // the rest of the usage line
  size_t min_positionals, max_positionals;
  int (*run)(const Arguments& arguments);  // result: an exit code; a Failure ends it early
};

struct Command : Call {
  const char* summary;  // one line
  std::string details;  // further lines of --help, or ""
  std::vector<Option> options;
};

/// The words after a command's name, sorted into options and the rest. Takes `--name value` and
/// `--name=value`. An option's former name is accepted for one version, with a note on stderr.
class Arguments {
 public:
  /// Fails (usage) on an unknown, repeated or not yet available option, a missing value, or too few
  /// or many words.
  Arguments(const Command& command, const std::vector<std::string>& words,
            const std::string& program = "firmtouch");

  bool wants_help() const { return wants_help_; }
  const std::vector<std::string>& words() const { return words_; }
  const std::vector<std::string>& positionals() const { return positionals_; }
  bool has(const std::string& option) const { return values_.count(option) != 0; }
  /// Of an option that may repeat: in order.
  std::vector<std::string> texts(const std::string& option) const;
  std::string text(const std::string& option, const std::string& otherwise = "") const;
  /// A whole number from `least` to `most`.
  uint32_t count(const std::string& option, uint32_t otherwise, uint32_t least,
                 uint32_t most) const;
  /// A finite number from `least` up.
  double number(const std::string& option, double otherwise, double least) const;
  /// One of `choices`.
  std::string choice(const std::string& option, const std::string& otherwise,
                     const std::vector<std::string>& choices) const;

  /// Fails (usage) with the command's name.
  [[noreturn]] void refuse(const std::string& what) const;

 private:
  std::string command_, full_name_;
  std::multimap<std::string, std::string> values_;
  std::vector<std::string> words_, positionals_;
  bool wants_help_ = false;
};

std::string help_of(const Command& command, const std::string& program = "firmtouch");

}  // namespace firmtouch::cli
