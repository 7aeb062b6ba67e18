#include <cmath>
#include <cstdlib>
#include <iostream>
#include <map>
#include <sstream>

#include "firmtouch/params/table.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/commands/logged_session.hpp"
#include "host_sim/commands/outputs.hpp"
#include "host_sim/report/score_page.hpp"
#include "host_sim/trace/log.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {
namespace {

struct ScoredRun {
  std::vector<ScoredTick> ticks;  // before the first gap
  ScoreSettings settings;
  std::string damage;  // in words; empty: the run is whole
};

double logged(const Log& log, params::Index row) {
  const auto found = log.text.find(std::string("parameter.") + params::kTable[row].name);
  return found == log.text.end() ? static_cast<double>(params::kTable[row].initial)
                                 : std::strtod(found->second.c_str(), nullptr);
}

void use(const cli::Arguments& options, ScoreSettings& settings) {
  settings.force_limit_N = options.number("--force-limit", settings.force_limit_N, 0);
  settings.tool_radius_m = options.number("--tool-radius", settings.tool_radius_m, 0);
  settings.stiffness_N_per_m = options.number("--stiffness", settings.stiffness_N_per_m, 0);
}

ScoredRun from_log(const std::string& path, const cli::Arguments& options) {
  const Log log = read_log(path);
  if (log.decimation != 1)
    throw Refused(path + ": it has not every tick; record with --decimate 1 to score it");
  ScoredRun run;
  if (!log.is_complete) run.damage = log.damage;
  run.settings = {1 / logged(log, params::kTickPeriod), logged(log, params::kForceLimit),
                  logged(log, params::kToolRadius), logged(log, params::kContactStiffness),
                  logged(log, params::kContactDamping)};
  use(options, run.settings);
  Environment environment;
  std::unique_ptr<Session> session;
  if (options.has("--asset")) {
    session = session_of(path, log, options.text("--asset"));
    environment = environment_of(
        *session->controller,
        {logged(log, params::kSceneX), logged(log, params::kSceneY), logged(log, params::kSceneZ)});
  }
  ContactTurn turn(&environment);
  for (const record::TickRecord& record : log.records)
    run.ticks.push_back(
        scored(record.output, wide(record.output.position_m), run.settings, environment, turn));
  return run;
}

// The columns of a run's CSV, by their names.
class CsvRun {
 public:
  CsvRun(const std::string& path, const std::string& text) : path_(path), lines_(text) {
    std::string name;
    next();
    for (size_t i = 0; std::getline(cells_, name, ','); ++i) columns_[name] = i;
  }
  bool next() {
    std::string line;
    if (!std::getline(lines_, line)) return false;
    ++line_;
    cells_ = std::istringstream(line);
    return true;
  }
  void read() {
    row_.clear();
    for (std::string cell; std::getline(cells_, cell, ',');)
      row_.push_back(std::strtod(cell.c_str(), nullptr));
  }
  size_t line() const { return line_; }
  double value(const std::string& name) const {
    const auto found = columns_.find(name);
    if (found == columns_.end()) throw Refused(path_ + ": it has no column " + name);
    if (found->second >= row_.size() || !std::isfinite(row_[found->second]))
      throw Refused(path_ + ":" + std::to_string(line_) + ": no finite value of " + name);
    return row_[found->second];
  }
  Vec vector(const std::string& name) const {
    return {value(name + "[0]"), value(name + "[1]"), value(name + "[2]")};
  }
  void read(const std::string& name, float (&floats)[3]) const {
    for (size_t k = 0; k < 3; ++k)
      floats[k] = static_cast<float>(value(name + "[" + std::to_string(k) + "]"));
  }

 private:
  std::string path_;
  std::istringstream lines_, cells_;
  std::map<std::string, size_t> columns_;
  std::vector<double> row_;
  size_t line_ = 0;
};

ScoredRun from_csv(const std::string& path, const cli::Arguments& options) {
  CsvRun csv(path, read_file(path));
  ScoredRun run;
  use(options, run.settings);
  Environment environment;
  std::unique_ptr<Session> session;
  if (options.has("--asset")) {
    session = std::make_unique<Session>(options.text("--asset"));
    environment = environment_of(*session->controller, {});
  }
  ContactTurn turn(&environment);
  double begin_s = 0, end_s = 0;
  while (csv.next()) {
    csv.read();
    const double time_s = csv.value("time_s"), count = static_cast<double>(run.ticks.size());
    if (run.ticks.empty()) begin_s = time_s;
    // A tick that is missing makes a step of at least two.
    const double step_s = count > 1 ? (end_s - begin_s) / (count - 1) : 0;
    if (count > 1 && std::fabs(time_s - end_s - step_s) > step_s / 2) {
      run.damage = "rows are missing before line " + std::to_string(csv.line());
      break;
    }
    end_s = time_s;
    record::TickOutput out{};
    out.state = static_cast<uint32_t>(csv.value("state"));
    csv.read("force_N", out.force_N);
    csv.read("position_m", out.position_m);
    csv.read("proxy_m", out.proxy_m);
    out.penetration_m = static_cast<float>(csv.value("penetration_m"));
    run.ticks.push_back(scored(out, csv.vector("device_m"), run.settings, environment, turn));
  }
  if (end_s > begin_s)
    run.settings.rate_Hz = static_cast<double>(run.ticks.size() - 1) / (end_s - begin_s);
  return run;
}

int score_run(const cli::Arguments& options) {
  const std::string path = options.positionals()[0], page = options.text("--page");
  check_outputs({{"the run", path}}, {{"--page", page}});
  const bool is_csv = path.size() > 4 && path.compare(path.size() - 4, 4, ".csv") == 0;
  const ScoredRun run = is_csv ? from_csv(path, options) : from_log(path, options);
  if (run.ticks.empty())
    throw Refused(path + ": it has no tick" + (run.damage.empty() ? "" : ": " + run.damage));
  if (!run.damage.empty())
    std::cerr << path << ": " << run.damage << "; the " << run.ticks.size()
              << " ticks before are scored\n";
  const ScoreSettings& settings = run.settings;
  const std::vector<ScoreRow> rows = rows_of(score_of(run.ticks, settings), settings);
  if (!page.empty()) write_file(page, score_page(path, rows, run.ticks, settings));
  std::cout << (options.has("--json") ? json_of(rows) + "\n" : csv_of(rows));
  int not_met = 0;
  for (const ScoreRow& row : rows) {
    if (row.is_met()) continue;
    ++not_met;
    std::cerr << "not met: " << row.figure << "\n";
  }
  return not_met == 0 && run.damage.empty() ? 0 : 1;
}

}  // namespace

cli::Command score_command() {
  return {
      {"score", "RUN.ftl|RUN.csv [options]", 1, 1, score_run},
      "figures of the contact in a run, each with its bar, as CSV; exit code 1 if one is not met, "
      "or the run is damaged",
      R"(Energy given, while no guide holds the tool: the largest gain of the work that the force
does at the tool, plus what the contact's spring holds. Contact on a guide is the proxy's
spring alone. From a log it is that of the encoders' positions, from a CSV of the device's.
A log has its settings; for a CSV they are the parameters' initial values, or those given
here. The stiffness of triangles' materials is the asset's, where it is given. Another
object's needs --stiffness, as does a tool of N spheres: 1/N of the wall's where one
touches. A part that moves gives energy of its own.)",
      {{"--page", "FILE.html", "the figures and charts of force, turn, energy and depth"},
       {"--asset", "FILE.fta", "of the run: turns of contact that its textures state do not count"},
       {"--force-limit", "N", "force_limit of the run"},
       {"--tool-radius", "M", "tool_radius of the run"},
       {"--stiffness", "N_PER_M", "contact_stiffness of the run"},
       {"--json", nullptr, "the figures as JSON"}}};
}

}  // namespace firmtouch::host_sim
