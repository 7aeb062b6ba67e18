#include "host_sim/commands/commands.hpp"

#include <algorithm>
#include <cstdlib>
#include <iostream>

namespace firmtouch::host_sim {
namespace {

constexpr const char* kVersion = "firmtouch-sim 0.1.0";  // as `firmtouch --version`
constexpr size_t kHelpColumn = 30;

constexpr const Command& (*kCommands[])() = {
    run_command_line,      replay_command_line,  record_command_line, live_command_line,
    scenario_command_line, view_command_line,    score_command_line,  bench_command_line,
    study_command_line,    z_width_command_line, device_command_line, home_command_line,
    compare_command_line,  sweep_command_line,   merge_command_line,  export_command_line,
    crash_command_line,    load_command_line};

std::string usage() {
  std::string text =
      "usage: firmtouch-sim COMMAND ...\n"
      "Runs a controller with a simulated device and a simulated hand.\n\n";
  for (const auto command : kCommands) {
    std::string line = std::string("  ") + command().name;
    line.resize(11, ' ');
    text += line + command().summary + "\n";
  }
  return text +
         "\nfirmtouch-sim COMMAND --help says more. Exit codes: 0 done, 1 the answer is no, "
         "2 usage, 3 bad input.\n";
}

}  // namespace

std::string help_of(const Command& command) {
  std::string text = std::string("usage: firmtouch-sim ") + command.name + " " + command.usage +
                     "\n" + command.summary + "\n\noptions\n";
  for (const Option& option : command.options) {
    std::string line = std::string("  ") + option.name;
    if (option.value != nullptr) line += std::string(" ") + option.value;
    line.resize(std::max(line.size() + 2, kHelpColumn), ' ');
    text += line + option.help + "\n";
  }
  std::string help = "  --help";
  help.resize(kHelpColumn, ' ');
  text += help + "this text\n";
  return command.details[0] == 0 ? text : text + "\n" + command.details;
}

Options::Options(const Command& command, const std::vector<std::string>& words)
    : command_(command.name), words_(words) {
  for (const std::string& word : words) help_ = help_ || word == "--help" || word == "-h";
  if (help_) return;
  for (size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word.size() < 2 || word[0] != '-') {
      operands_.push_back(word);
      continue;
    }
    const size_t equals = word.compare(0, 2, "--") == 0 ? word.find('=') : std::string::npos;
    const std::string name = word.substr(0, equals);
    const auto found = std::find_if(command.options.begin(), command.options.end(),
                                    [&](const Option& option) { return name == option.name; });
    if (found == command.options.end()) refuse("unknown option " + name);
    if (found->value == nullptr) {
      if (equals != std::string::npos) refuse(name + " takes no value");
      given_.emplace_back(name, "");
    } else if (equals != std::string::npos) {
      given_.emplace_back(name, word.substr(equals + 1));
    } else if (i + 1 < words.size()) {
      given_.emplace_back(name, words[++i]);
    } else {
      refuse(name + " needs a value: " + name + " " + found->value);
    }
  }
}

void Options::refuse(const std::string& what) const {
  throw Usage(command_ + ": " + what + " (see firmtouch-sim " + command_ + " --help)");
}

bool Options::has(const std::string& name) const {
  return std::any_of(given_.begin(), given_.end(),
                     [&](const auto& given) { return given.first == name; });
}

std::string Options::value(const std::string& name) const {
  const std::vector<std::string> all = values(name);
  return all.empty() ? "" : all.back();
}

std::vector<std::string> Options::values(const std::string& name) const {
  std::vector<std::string> all;
  for (const auto& [key, value] : given_)
    if (key == name) all.push_back(value);
  return all;
}

double Options::number(const std::string& name, double otherwise, double least) const {
  const std::string text = value(name);
  if (text.empty()) return otherwise;
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (*end != 0 || !(number >= least))
    refuse(name + " " + text + ": a number not below " + std::to_string(static_cast<int>(least)) +
           " is needed");
  return number;
}

const std::string& Options::operand(const std::string& what) const {
  if (operands_.empty()) refuse("name " + what);
  if (operands_.size() > 1) refuse("one word too many: '" + operands_[1] + "'");
  return operands_[0];
}

int run_command(const std::vector<std::string>& words) {
  if (words.empty()) {
    std::cerr << usage();
    return 2;
  }
  if (words[0] == "--help" || words[0] == "-h" || words[0] == "help") {
    std::cout << usage();
    return 0;
  }
  if (words[0] == "--version") {
    std::cout << kVersion << "\n";
    return 0;
  }
  for (const auto command_line : kCommands) {
    const Command& command = command_line();
    if (words[0] != command.name) continue;
    const Options options(command, {words.begin() + 1, words.end()});
    if (!options.help()) return command.run(options);
    std::cout << help_of(command);
    return 0;
  }
  throw Usage("'" + words[0] + "' is no command (see firmtouch-sim --help)");
}

}  // namespace firmtouch::host_sim
