#include <algorithm>
#include <cstdio>
#include <iostream>

#include "firmtouch/link/build_id.hpp"
#include "firmtouch/params/table.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/commands/outputs.hpp"
#include "host_sim/commands/progress.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/report/report.hpp"
#include "host_sim/report/summary.hpp"
#include "host_sim/trace/csv.hpp"
#include "host_sim/trace/log.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr const char* kHelp =
    "firmtouch-sim run SCENARIO [options]\n"
    "  --set KEY=VALUE          override a line of the scenario, with unit: "
    "--set \"mass=60 g\"; may be repeated\n"
    "  --controller WHAT        inproc (default) | qemu:BOARD | unix:PATH | tcp:HOST:PORT | DEVICE "
    "(serial)\n"
    "                           every other controller is compared with the in-process one, bit "
    "for bit\n"
    "  --image FILE             the program for qemu:BOARD (default: "
    "build/BOARD/bin/firmtouch_app.elf)\n"
    "  --report FILE.html       report: 3D view, charts and figures in one file\n"
    "  --picture FILE.svg       the report's 3D view and force chart\n"
    "  --log FILE.ftl           input and output of every tick, for `firmtouch-sim replay`\n"
    "  --csv FILE.csv           the same as text\n\n";

std::string hex(uint64_t value, int digits) {
  char text[24];
  std::snprintf(text, sizeof text, "%0*llx", digits, static_cast<unsigned long long>(value));
  return text;
}

std::string line_of(std::string set) {
  const size_t equals = set.find('=');
  if (equals == std::string::npos) throw Usage("--set " + set + ": write --set key=value");
  set[equals] = ' ';
  // "1N" is accepted as "1 N".
  const size_t unit = set.find_first_not_of("0123456789.+-eE", equals + 1);
  const std::string key = set.substr(0, equals);
  const bool is_text = key == "asset" || key == "mesh" || key == "guide";
  if (!is_text && unit != std::string::npos && unit > equals + 1 && set[unit] != ' ' &&
      set.find(' ', equals + 1) == std::string::npos)
    set.insert(unit, " ");
  return set;
}

Log log_of(const Scenario& scenario, const Session& session, const Trace& trace,
           const std::string& log_path) {
  Log log;
  log.text["asset"] = path_from(log_path, session.asset.path());
  log.text["asset_crc"] = hex(session.controller->asset_crc(), 8);
  log.text["asset_bytes"] = std::to_string(session.asset.bytes().size());
  log.text["parameter_table"] = hex(params::table_hash(), 16);
  log.text["build"] = hex(link::build_id(), 16);
  log.text["controller"] = trace.controller;
  if (!session.used.surface.empty()) log.text["surface"] = session.used.surface;
  if (!session.used.guide.empty()) log.text["guide"] = session.used.guide;
  log.text["scenario"] = scenario.text;
  for (uint32_t i = 0; i < params::kCount; ++i) {
    char value[32];
    std::snprintf(value, sizeof value, "%.9g %s", parameter_value(scenario, i),
                  params::kTable[i].unit);
    log.text[std::string("parameter.") + params::kTable[i].name] = value;
  }
  log.records = trace.records;
  return log;
}

std::string command_of(const std::vector<std::string>& words) {
  std::string text = "firmtouch-sim run";
  for (const std::string& word : words)
    text += word.find_first_of(" '\"$") == std::string::npos ? " " + word : " '" + word + "'";
  return text;
}

}  // namespace

int run_scenario(const std::vector<std::string>& words) {
  const Options options(
      words, {"--set", "--controller", "--image", "--report", "--picture", "--log", "--csv"});
  if (options.help()) {
    std::cout << kHelp << scenario_help() << parameter_help();
    return 0;
  }
  if (options.operands().size() != 1) throw Usage("run needs one scenario");
  const std::string file = options.operands()[0];
  std::vector<std::string> sets;
  for (const std::string& set : options.values("--set")) sets.push_back(line_of(set));
  Scenario scenario = read_scenario(file, read_file(file), sets, parameter_rows());
  complete(scenario);
  NamedFiles outputs;
  for (const char* name : {"--report", "--picture", "--log", "--csv"})
    outputs.emplace_back(name, options.value(name));
  check_outputs({{"the scenario", file},
                 {"the asset", path_beside(file, scenario.asset)},
                 {"--image", options.value("--image")}},
                outputs);
  const Session session(path_beside(file, scenario.asset), scenario.scene);
  Environment environment = environment_of(*session.controller, scene_origin_m(scenario));
  environment.turn(parameter_value(scenario, params::kSurfaceTurned) >= 0.5);
  const std::unique_ptr<LockStepController> port =
      open_controller(options.value("--controller"), options.value("--image"), session.asset.path(),
                      session.controller->asset_crc());
  check_scene(session, port != nullptr);
  const Trace trace =
      run(scenario, *session.controller, environment, port.get(), progress_bar("simulating"));
  const Summary summary = summarise(scenario, environment, trace);

  if (const std::string path = options.value("--csv"); !path.empty())
    write_file(path, csv_of(trace));
  if (const std::string path = options.value("--log"); !path.empty())
    write_log(path, log_of(scenario, session, trace, path));
  if (!options.value("--report").empty() || !options.value("--picture").empty()) {
    const Report report{scenario,
                        environment,
                        trace,
                        summary,
                        session.asset.path(),
                        session.asset.bytes().size(),
                        session.scene_text(),
                        command_of(words)};
    if (const std::string path = options.value("--report"); !path.empty())
      write_file(path, page_of(report));
    if (const std::string path = options.value("--picture"); !path.empty())
      write_file(path, picture_of(report));
  }
  std::cerr << "  scene          " << session.scene_text() << "\n" << text_of(summary, trace);
  if (trace.difference) {
    const Difference& d = *trace.difference;
    std::cerr << "firmtouch-sim: " << trace.controller
              << " differs from the in-process controller first at tick " << d.tick << " in "
              << d.field << ": in-process " << d.expected << ", " << trace.controller << " "
              << d.found << "\n";
    return 1;
  }
  if (summary.wrong_bounds > 0) {
    std::cerr << "firmtouch-sim: " << summary.wrong_bounds
              << " certificates are wrong; this is a defect, please report it\n";
    return 1;
  }
  return 0;
}

}  // namespace firmtouch::host_sim
