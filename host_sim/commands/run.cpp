#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <functional>
#include <iostream>
#include <map>
#include <optional>

#include "device/machines.hpp"
#include "firmtouch/link/build_id.hpp"
#include "firmtouch/params/table.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/commands/outputs.hpp"
#include "host_sim/commands/prepare.hpp"
#include "host_sim/commands/progress.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/device/linkage_body.hpp"
#include "host_sim/report/held_proxy.hpp"
#include "host_sim/report/report.hpp"
#include "host_sim/report/summary.hpp"
#include "host_sim/trace/csv.hpp"
#include "host_sim/trace/log.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kMaxBalanceError = 1e-5;

std::string hex(uint64_t value, int digits) {
  char text[24];
  std::snprintf(text, sizeof text, "%0*llx", digits, static_cast<unsigned long long>(value));
  return text;
}

std::map<std::string, std::string> log_text(const Scenario& scenario, const Session& session,
                                            const RunFacts& facts, const std::string& log_path) {
  std::map<std::string, std::string> text;
  text["asset"] = path_from(log_path, session.asset.path());
  text["asset_crc"] = hex(session.controller->asset_crc(), 8);
  text["asset_bytes"] = std::to_string(session.asset.bytes().size());
  text["parameter_table"] = hex(params::table_hash(), 16);
  text["build"] = hex(link::build_id(), 16);
  text["controller"] = facts.controller;
  if (session.penalty) text["contact"] = "penalty";
  if (!session.used.surface.empty()) text["surface"] = session.used.surface;
  if (!session.used.guide.empty()) text["guide"] = session.used.guide;
  text["scenario"] = scenario.text;
  for (uint32_t i = 0; i < params::kCount; ++i) {
    char value[32];
    std::snprintf(value, sizeof value, "%.9g %s", parameter_value(scenario, i),
                  params::kTable[i].unit);
    text[std::string("parameter.") + params::kTable[i].name] = value;
  }
  return text;
}

std::string command_of(const std::vector<std::string>& words) {
  std::string text = "firmtouch-sim run";
  for (const std::string& word : words)
    text += word.find_first_of(" '\"$") == std::string::npos ? " " + word : " '" + word + "'";
  return text;
}

// What a run writes while it goes on.
class RunOutputs {
 public:
  RunOutputs(const cli::Arguments& options, const Scenario& scenario, const Session& session,
             const Environment& environment, const RunFacts& facts)
      : facts_(facts), summariser_(scenario, environment, facts), proxies_(session) {
    if (const std::string path = options.text("--csv"); !path.empty()) csv_.emplace(path);
    if (const std::string path = options.text("--log"); !path.empty())
      log_.emplace(path, log_text(scenario, session, facts, path));
    if (!options.text("--report").empty() || !options.text("--picture").empty()) {
      charts_.emplace(environment, facts, scenario.linkage ? &*scenario.linkage : nullptr);
      paths_.emplace(environment, scenario, facts);
    }
  }
  void add(const RunTick& tick) {
    if (csv_) csv_->add(tick, tick.record.input.tick / facts_.rate_Hz);
    if (log_) log_->add(tick.record);
    if (charts_) charts_->add(tick), paths_->add(tick, proxies_.after(tick.record));
    summariser_.add(tick);
  }
  Summary finish() {
    if (csv_) csv_->finish();
    if (log_) log_->finish();
    Summary summary = summariser_.finish();
    if (charts_) charts_->finish(summary);
    return summary;
  }
  const RunCharts& charts() const { return *charts_; }
  const RunPaths& paths() const { return *paths_; }

 private:
  const RunFacts& facts_;
  Summariser summariser_;
  HeldProxies proxies_;
  std::optional<CsvStream> csv_;
  std::optional<LogStream> log_;
  std::optional<RunCharts> charts_;
  std::optional<RunPaths> paths_;
};

// A path that ends in / is a folder: the report is named after its model.
std::string report_path(const cli::Arguments& options, const std::string& asset_path) {
  const std::string path = options.text("--report");
  return path.empty() || path.back() != '/'
             ? path
             : path + std::filesystem::path(asset_path).stem().string() + ".html";
}

void write_pages(const cli::Arguments& options, const Report& report) {
  if (const std::string path = report_path(options, report.asset_path); !path.empty())
    write_file(path, page_of(report));
  if (const std::string path = options.text("--picture"); !path.empty())
    write_file(path, picture_of(report));
}

int exit_code(const RunFacts& facts, const Summary& summary) {
  if (facts.difference) {
    const Difference& d = *facts.difference;
    std::cerr << "firmtouch-sim: " << facts.controller
              << " differs from the in-process controller first at tick " << d.tick << " in "
              << d.field << ": in-process " << d.expected << ", " << facts.controller << " "
              << d.found << "\n";
    return 1;
  }
  if (summary.wrong_bounds == 0) return 0;
  std::cerr << "firmtouch-sim: " << summary.wrong_bounds
            << " certificates are wrong; this is a defect, please report it\n";
  return 1;
}

// Result: whether the balance holds.
bool print_energy(std::FILE* to, const EnergyBook& book) {
  const double error = book.turnover_J > 0 ? book.error_J() / book.turnover_J : 0;
  std::fprintf(to,
               "  energy         hand %.4g J, motors %.4g J, lost %.4g J, stored %.4g J; balance "
               "within %.1e of %.4g J\n",
               book.hand_J, book.motors_J, book.lost_J, book.stored_J - book.start_J,
               std::fabs(error), book.turnover_J);
  if (std::fabs(error) <= kMaxBalanceError) return true;
  std::cerr
      << "firmtouch-sim: the energy does not balance to " << kMaxBalanceError
      << ": a cable rings or a stop is too stiff for steps of 20 us; state cable_damping_, or "
         "lower cable_ or stop_stiffness\n";
  return false;
}

// Processor time of this process; of a controller outside of it the time that passes.
class Speed {
 public:
  void print(std::FILE* to, const RunFacts& facts) const {
    const double used_s = static_cast<double>(std::clock() - used_) / CLOCKS_PER_SEC;
    std::fprintf(to, "  speed          %.3g times real time (%.3g s of processor time)",
                 facts.ticks / facts.rate_Hz / std::max(used_s, 1e-6), used_s);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - began_;
    if (facts.compared)
      std::fprintf(to, "; %.0f ticks a second with the controller (%.3g s)",
                   facts.ticks / std::max(passed.count(), 1e-6), passed.count());
    std::fprintf(to, "\n");
  }

 private:
  std::clock_t used_ = std::clock();
  std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
};

// Where the summary goes: stdout, or stderr if an output or the JSON goes to stdout. Throws Usage
// if both do, or two outputs.
std::FILE* summary_stream(const cli::Arguments& options, const NamedFiles& outputs) {
  size_t count = options.has("--json") ? 1 : 0;
  for (const auto& output : outputs) count += output.second == "-" ? 1u : 0u;
  if (count > 1) options.refuse("only one output can go to stdout");
  if (options.text("--log") == "-") options.refuse("a log needs a file: --log FILE.ftl");
  return count == 0 ? stdout : stderr;
}

int run_scenario(const cli::Arguments& options) {
  const std::string file = options.positionals()[0];
  std::vector<std::string> sets;
  for (const std::string& set : options.texts("--set")) sets.push_back(line_of(set));
  Scenario scenario = prepared(file, read_file(file), sets);
  NamedFiles outputs = {{"--report", report_path(options, scenario.asset)}};
  for (const char* name : {"--picture", "--log", "--csv"})
    outputs.emplace_back(name, options.text(name));
  std::FILE* const to = summary_stream(options, outputs);
  check_outputs(
      {{"the scenario", file},
       {"the asset", path_beside(file, scenario.asset)},
       {"the recorded hand", scenario.hand_log.empty() ? "" : path_beside(file, scenario.hand_log)},
       {"--image", options.text("--image")}},
      outputs);
  const Session session(path_beside(file, scenario.asset), scenario.scene,
                        options.has("--penalty") ? Contact::kPenalty : Contact::kProxy);
  Environment environment = environment_of(*session.controller, scene_origin_m(scenario));
  environment.turn(parameter_value(scenario, params::kSurfaceTurned) >= 0.5);
  check_scene(session, options.text("--controller"));
  const std::unique_ptr<LockStepController> port =
      open_controller(options.text("--controller"), options.text("--image"), session.asset.path(),
                      session.controller->asset_crc(), session.program(), wait_s(options));
  read_linkage(scenario, session, file);
  if (options.has("--energy") && !scenario.linkage)
    options.refuse("--energy is of a linkage: name one in the scenario, `device FILE`");
  const Speed speed;
  Simulation simulation(scenario, session.tick(), environment, port.get());
  const RunFacts& facts = simulation.facts();
  RunOutputs written(options, scenario, session, environment, facts);
  const std::function<void(double)> progress = progress_bar("simulating");
  for (RunTick tick; simulation.next(tick);) {
    written.add(tick);
    if (progress && tick.record.input.tick % 256 == 0)
      progress(static_cast<double>(tick.record.input.tick) / facts.ticks);
  }
  if (progress) progress(1);
  const Summary summary = written.finish();
  if (!options.text("--report").empty() || !options.text("--picture").empty())
    write_pages(options, {scenario, environment, facts, summary, written.charts(), written.paths(),
                          session.asset.path(), static_cast<uint32_t>(session.asset.bytes().size()),
                          session.scene_text(), command_of(options.words())});
  speed.print(to, facts);
  if (options.has("--json")) std::cout << json_of(summary, facts);
  std::fprintf(to, "  scene          %s\n%s", session.scene_text().c_str(),
               text_of(summary, facts).c_str());
  const bool is_balanced = !options.has("--energy") || print_energy(to, *simulation.energy());
  const int code = exit_code(facts, summary);
  return code == 0 && !is_balanced ? 1 : code;
}

}  // namespace

cli::Command run_command() {
  return {
      {"run", "SCENARIO [options]", 1, 1, run_scenario},
      "simulates a scenario: a hand moves a device, and the controller renders the force",
      scenario_help() + parameter_help(),
      {{"--set", "KEY=VALUE",
        "overrides a line of the scenario, with unit: \"mass=60 g\"; may be repeated", true},
       {"--controller", "WHAT",
        "inproc (default), qemu:BOARD, unix:PATH, tcp:HOST:PORT or a serial DEVICE;\n"
        "                              others are compared with the in-process one, bit for bit"},
       {"--image", "FILE",
        "the program for qemu:BOARD (default: build/BOARD/bin/firmtouch_app.elf)"},
       wait_option(),
       {"--penalty", nullptr, "penalty contact instead of a proxy, for comparison"},
       {"--report", "FILE.html",
        "report: 3D view, the planes that hold the proxy, charts and figures in one file;\n"
        "                              FOLDER/ names it after its model"},
       {"--picture", "FILE.svg", "the report's 3D view and force chart"},
       {"--log", "FILE.ftl", "input and output of every tick, for `firmtouch-sim replay`"},
       {"--csv", "FILE.csv", "the same as text; - is stdout, also for --report and --picture"},
       {"--energy", nullptr,
        "of a linkage: work of hand and motors, stored and lost energy; exit code 1 where they\n"
        "                              do not balance to 1e-5"},
       {"--json", nullptr, "the figures as JSON on stdout"}}};
}

}  // namespace firmtouch::host_sim
