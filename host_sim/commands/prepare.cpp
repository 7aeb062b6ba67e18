#include "host_sim/commands/prepare.hpp"

#include "device/machines.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/trace/recorded_hand.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {

std::string line_of(std::string set) {
  const size_t equals = set.find('=');
  if (equals == std::string::npos) cli::fail_usage("--set " + set + ": write --set key=value");
  set[equals] = ' ';
  // "1N" is accepted as "1 N".
  const size_t unit = set.find_first_not_of("0123456789.+-eE", equals + 1);
  const std::string key = set.substr(0, equals);
  const bool is_text =
      key == "asset" || key == "device" || key == "hand_log" || key == "mesh" || key == "guide";
  if (!is_text && unit != std::string::npos && unit > equals + 1 && set[unit] != ' ' &&
      set.find(' ', equals + 1) == std::string::npos)
    set.insert(unit, " ");
  return set;
}

Scenario prepared(const std::string& file, const std::string& text,
                  const std::vector<std::string>& sets) {
  Scenario scenario = read_scenario(file, text, sets, parameter_rows());
  complete(scenario);
  if (!scenario.hand_log.empty())
    scenario.recorded = recorded_hand(path_beside(file, scenario.hand_log));
  return scenario;
}

void read_linkage(Scenario& scenario, const Session& session, const std::string& file) {
  const device::StoredLinkage& stored = session.controller->linkage();
  const bool is_named = !scenario.device_file.empty();
  if (!is_named && !stored.is_open()) return;
  if (!is_named) throw Refused(file + ": its asset stores a linkage; name its file: `device FILE`");
  const bool is_machine = !tools::machine_text(scenario.device_file).empty();
  const std::string path =
      is_machine ? scenario.device_file : path_beside(file, scenario.device_file);
  scenario.linkage = tools::read_device(path, tools::read_device_text(path));
  if (!stored.is_open())
    throw Refused(file + ": its asset stores no linkage; bake it with --device " +
                  scenario.device_file);
  const std::vector<uint8_t> wanted = tools::stored_bytes_of(*scenario.linkage);
  const core::Bytes found = session.controller->device().stored_bytes();
  if (wanted != std::vector<uint8_t>(found.data(), found.data() + found.size()))
    throw Refused(path + ": the asset stores another linkage; bake it again with --device");
}

}  // namespace firmtouch::host_sim
