#include "host_sim/commands/commands.hpp"

#include <algorithm>
#include <iostream>

namespace firmtouch::host_sim {
namespace {

constexpr const char* kHelp =
    "firmtouch-sim runs a controller with a simulated device and a simulated hand.\n\n"
    "  firmtouch-sim run SCENARIO [options]      simulate a scenario (run --help: options, and "
    "the scenario's syntax)\n"
    "  firmtouch-sim replay LOG [options]        recompute a log from its inputs and compare "
    "every output bit\n"
    "  firmtouch-sim record CONTROLLER -o FILE   record a running controller over its link\n"
    "  firmtouch-sim scenario ASSET -o FILE      write a scenario for an asset: press on the "
    "surface, follow the guide\n"
    "  firmtouch-sim z-width [options]           limits of stable walls, and their bars\n\n"
    "`firmtouch-sim COMMAND --help` lists a command's options.\n"
    "Exit codes: 0 done; 1 it ran and the answer is no; 2 usage; 3 bad input.\n";

}  // namespace

Options::Options(const std::vector<std::string>& words,
                 const std::vector<std::string>& with_value) {
  for (size_t i = 0; i < words.size(); ++i) {
    const std::string& word = words[i];
    if (word == "--help" || word == "-h") {
      help_ = true;
    } else if (word.size() < 2 || word[0] != '-') {
      operands_.push_back(word);
    } else {
      const size_t equals = word.compare(0, 2, "--") == 0 ? word.find('=') : std::string::npos;
      const std::string name = word.substr(0, equals);
      if (std::find(with_value.begin(), with_value.end(), name) == with_value.end())
        throw Usage("unknown option " + name);
      if (equals == std::string::npos && i + 1 == words.size())
        throw Usage(name + " needs a value");
      given_.emplace_back(name, equals != std::string::npos ? word.substr(equals + 1) : words[++i]);
    }
  }
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

int run_command(const std::vector<std::string>& words) {
  if (words.empty()) throw Usage("name a command: run, replay, record, scenario or z-width");
  const std::vector<std::string> rest(words.begin() + 1, words.end());
  if (words[0] == "run") return run_scenario(rest);
  if (words[0] == "replay") return replay_log(rest);
  if (words[0] == "record") return record_live(rest);
  if (words[0] == "scenario") return make_scenario(rest);
  if (words[0] == "z-width") return print_z_width(rest);
  if (words[0] == "--help" || words[0] == "-h" || words[0] == "help") {
    std::cout << kHelp;
    return 0;
  }
  throw Usage("unknown command `" + words[0] + "`; known: run, replay, record, scenario, z-width");
}

}  // namespace firmtouch::host_sim
