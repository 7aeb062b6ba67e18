#include "cli/arguments.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>

#include "cli/failure.hpp"

namespace firmtouch::cli {
namespace {

constexpr size_t kHelpColumn = 30;

const Option* find(const Command& command, const std::string& name) {
  for (const Option& option : command.options) {
    if (name == option.name) return &option;
  }
  return nullptr;
}

// Former names of options: accepted in this version and dropped in the next one.
struct RenamedOption {
  const char* command;
  const char* former;
  const char* name;
};
constexpr RenamedOption kRenamed[] = {{"bake", "--steady", "--bounded"}};

std::string current_name(const std::string& command, const std::string& given) {
  for (const RenamedOption& renamed : kRenamed) {
    if (command != renamed.command || given != renamed.former) continue;
    std::fprintf(stderr,
                 "firmtouch: %s: %s is called %s now; the former name goes with the next version\n",
                 renamed.command, renamed.former, renamed.name);
    return renamed.name;
  }
  return given;
}

// "firmtouch bake", or the program alone where it has no commands.
std::string full_name(const Command& command, const std::string& program) {
  return command.name[0] == 0 ? program : program + " " + command.name;
}

bool is_option(const std::string& word) { return word.size() > 1 && word[0] == '-' && word != "-"; }

template <class Number>
bool parse(const std::string& text, Number& value) {
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  return result.ec == std::errc() && result.ptr == text.data() + text.size();
}

}  // namespace

Arguments::Arguments(const Command& command, const std::vector<std::string>& words,
                     const std::string& program)
    : command_(command.name[0] != 0 ? std::string(command.name) + ": " : ""),
      full_name_(full_name(command, program)),
      words_(words) {
  for (const std::string& word : words) {
    if (word == "--help" || word == "-h") wants_help_ = true;
  }
  if (wants_help_) return;
  for (size_t i = 0; i < words.size(); ++i) {
    if (!is_option(words[i])) {
      positionals_.push_back(words[i]);
      continue;
    }
    const size_t equals = words[i].find('=');
    const std::string name = current_name(command.name, words[i].substr(0, equals));
    const Option* option = find(command, name);
    if (option == nullptr) refuse("unknown option " + name);
    if (option->help == nullptr)
      refuse(name + " is not in this version of Firmtouch yet; leave it out");
    if (has(name) && !option->may_repeat) refuse(name + " is given twice; give it once");
    std::string value;
    if (option->value == nullptr) {
      if (equals != std::string::npos) refuse(name + " takes no value");
    } else if (equals != std::string::npos) {
      value = words[i].substr(equals + 1);
    } else if (i + 1 < words.size() && words[i + 1].compare(0, 2, "--") != 0) {
      value = words[++i];
    } else {
      refuse(name + " needs a value: " + name + " " + option->value);
    }
    values_.emplace(name, value);
  }
  if (positionals_.size() < command.min_positionals)
    refuse("something is missing: " + full_name_ + " " + command.usage);
  if (positionals_.size() > command.max_positionals) {
    refuse("one word too many: '" + positionals_[command.max_positionals] + "'");
  }
}

void Arguments::refuse(const std::string& what) const {
  fail_usage(command_ + what + " (see " + full_name_ + " --help)");
}

std::vector<std::string> Arguments::texts(const std::string& option) const {
  std::vector<std::string> all;
  for (const auto& [name, value] : values_)
    if (name == option) all.push_back(value);
  return all;
}

std::string Arguments::text(const std::string& option, const std::string& otherwise) const {
  const auto found = values_.find(option);
  return found == values_.end() ? otherwise : found->second;
}

uint32_t Arguments::count(const std::string& option, uint32_t otherwise, uint32_t least,
                          uint32_t most) const {
  if (!has(option)) return otherwise;
  uint32_t value = 0;
  if (!parse(text(option), value) || value < least || value > most) {
    refuse(option + " " + text(option) + ": a whole number from " + std::to_string(least) + " to " +
           std::to_string(most) + " is needed");
  }
  return value;
}

double Arguments::number(const std::string& option, double otherwise, double least) const {
  if (!has(option)) return otherwise;
  double value = 0;
  if (!parse(text(option), value) || !std::isfinite(value) || !(value >= least)) {
    char from[32];
    std::snprintf(from, sizeof from, "%g", least);
    refuse(option + " " + text(option) + ": a number not below " + from + " is needed");
  }
  return value;
}

std::string Arguments::choice(const std::string& option, const std::string& otherwise,
                              const std::vector<std::string>& choices) const {
  const std::string value = text(option, otherwise);
  if (std::find(choices.begin(), choices.end(), value) != choices.end()) return value;
  std::string listed;
  for (const std::string& choice : choices) listed += (listed.empty() ? "" : ", ") + choice;
  refuse(option + " " + value + ": one of " + listed + " is needed");
}

std::string help_of(const Command& command, const std::string& program) {
  std::string text =
      "usage: " + full_name(command, program) + " " + command.usage + "\n" + command.summary + "\n";
  if (!command.details.empty()) text += "\n" + command.details + "\n";
  text += "\noptions\n";
  std::string later;
  for (const Option& option : command.options) {
    if (option.help == nullptr) {
      later += std::string(later.empty() ? "" : " ") + option.name;
      continue;
    }
    std::string line = std::string("  ") + option.name;
    if (option.value != nullptr) line += std::string(" ") + option.value;
    line.resize(std::max(line.size() + 2, kHelpColumn), ' ');
    text += line + option.help + "\n";
  }
  std::string help = "  --help";
  help.resize(kHelpColumn, ' ');
  text += help + "this text\n";
  if (!later.empty()) text += "\nplanned, refused so far: " + later + "\n";
  return text;
}

}  // namespace firmtouch::cli
