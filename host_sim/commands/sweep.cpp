#include <algorithm>
#include <cstdio>

#include "batch/parallel.hpp"
#include "batch/results.hpp"
#include "device/machines.hpp"
#include "firmtouch/core/hash.hpp"
#include "firmtouch/link/build_id.hpp"
#include "firmtouch/params/table.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/commands/outputs.hpp"
#include "host_sim/commands/prepare.hpp"
#include "host_sim/commands/progress.hpp"
#include "host_sim/report/score_page.hpp"
#include "host_sim/sweep/plan.hpp"
#include "host_sim/trace/log.hpp"

namespace firmtouch::host_sim {
namespace {

// A scenario and what varies in it.
struct Sweep {
  std::string file, text;
  std::vector<Varied> varied;
  Contact contact = Contact::kProxy;

  Scenario scenario(uint64_t run) const {
    std::vector<std::string> lines;
    const std::vector<std::string> values = values_of(varied, run);
    for (size_t i = 0; i < values.size(); ++i)
      lines.push_back(line_of(varied[i].key + "=" + values[i]));
    return prepared(file, text, lines);
  }
};

void add(core::Hash& hash, const std::string& text) {
  for (const char c : text) hash.add(static_cast<unsigned char>(c));
  hash.add(static_cast<uint32_t>(text.size()));
}

// All that the rows depend on. Reads each run's scenario, so that what it refuses is said at once.
tools::BatchIdentity identity_of(const Sweep& sweep) {
  tools::BatchIdentity identity{combinations(sweep.varied), 0};
  core::Hash hash;
  hash.add(static_cast<uint32_t>(link::build_id()));
  hash.add(sweep.contact == Contact::kPenalty ? 1 : 0);
  std::string asset, device;  // of the run before
  for (uint64_t run = 0; run < identity.runs; ++run) {
    const Scenario scenario = sweep.scenario(run);
    add(hash, scenario.text);
    if (scenario.asset != asset) add(hash, read_file(path_beside(sweep.file, scenario.asset)));
    asset = scenario.asset;
    const std::string path = path_beside(sweep.file, scenario.device_file);
    if (scenario.device_file != device && tools::machine_text(scenario.device_file).empty())
      add(hash, read_file(path));
    device = scenario.device_file;
  }
  identity.hash = hash.value();
  return identity;
}

std::vector<ScoreRow> score_of_run(const Sweep& sweep, uint64_t run, uint32_t& faults) {
  Scenario scenario = sweep.scenario(run);
  const Session session(path_beside(sweep.file, scenario.asset), scenario.scene, sweep.contact);
  Environment environment = environment_of(*session.controller, scene_origin_m(scenario));
  environment.turn(parameter_value(scenario, params::kSurfaceTurned) >= 0.5);
  read_linkage(scenario, session, sweep.file);
  Simulation simulation(scenario, session.tick(), environment);
  const ScoreSettings settings = {scenario.rate_Hz, parameter_value(scenario, params::kForceLimit),
                                  parameter_value(scenario, params::kToolRadius),
                                  parameter_value(scenario, params::kContactStiffness),
                                  parameter_value(scenario, params::kContactDamping)};
  std::vector<ScoredTick> ticks;
  ContactTurn turn(&environment);
  for (RunTick tick; simulation.next(tick);) {
    ticks.push_back(scored(tick.record.output, tick.device_m, settings, environment, turn));
    faults |= tick.record.output.faults;
  }
  return rows_of(score_of(ticks, settings), settings);
}

std::string header_of(const Sweep& sweep) {
  std::string text;
  for (const Varied& varied : sweep.varied) text += varied.key + ",";
  for (const ScoreRow& row : rows_of(Score{}, ScoreSettings{}))
    text += "\"" + row.figure + (row.unit.empty() ? "" : " [" + row.unit + "]") + "\",";
  return text + "not met,faults";
}

std::string row_of(const Sweep& sweep, uint64_t run) {
  std::string text;
  for (const std::string& value : values_of(sweep.varied, run)) text += value + ",";
  uint32_t faults = 0, not_met = 0;
  for (const ScoreRow& row : score_of_run(sweep, run, faults)) {
    char number[32];
    std::snprintf(number, sizeof number, "%.9g,", row.value);
    text += number;
    not_met += row.is_met() ? 0u : 1u;
  }
  return text + std::to_string(not_met) + "," + std::to_string(faults);
}

int run_sweep(const cli::Arguments& options) {
  Sweep sweep;
  sweep.file = options.positionals()[0];
  sweep.text = read_file(sweep.file);
  for (const std::string& text : options.texts("--vary")) sweep.varied.push_back(varied_of(text));
  if (options.has("--penalty")) sweep.contact = Contact::kPenalty;
  const std::string path = options.text("-o");
  if (path.empty()) options.refuse("name the file of the results: -o FILE.csv");
  check_outputs({{"the scenario", sweep.file}}, {{"-o", path}});
  const tools::Shard shard =
      options.has("--shard") ? tools::shard_of(options.text("--shard")) : tools::Shard{};
  const double jobs = std::min(options.number("--jobs", tools::processors(), 1), 1024.0);
  const tools::BatchIdentity identity = identity_of(sweep);
  tools::BatchResults results(path, header_of(sweep), identity, shard);
  const uint64_t count = shard.runs(identity.runs);
  if (results.had() > 0)
    std::fprintf(stderr, "%s: has %llu of %llu runs; going on\n", path.c_str(),
                 static_cast<unsigned long long>(results.had()),
                 static_cast<unsigned long long>(count));
  const uint64_t had = results.had();
  tools::in_parallel(
      count - had, static_cast<uint32_t>(jobs),
      [&](uint64_t i) {
        const uint64_t run = shard.run(had + i);
        try {
          results.add(had + i, row_of(sweep, run));
        } catch (const std::exception& error) {
          throw Refused("run " + std::to_string(run) + ": " + error.what());
        }
      },
      progress_bar("sweeping"));
  std::printf("%s: %llu runs\n", path.c_str(), static_cast<unsigned long long>(count));
  return 0;
}

int merge_sweep(const cli::Arguments& options) {
  std::vector<std::pair<std::string, std::string>> files;
  NamedFiles inputs;
  for (const std::string& path : options.positionals()) {
    files.emplace_back(path, read_file(path));
    inputs.emplace_back(path, path);
  }
  const std::string path = options.text("-o");
  if (path.empty()) options.refuse("name the file of all results: -o FILE.csv");
  check_outputs(inputs, {{"-o", path}});
  write_file(path, tools::merged(files));
  return 0;
}

}  // namespace

cli::Command sweep_command() {
  return {
      {"sweep", "SCENARIO --vary KEY=VALUES... -o FILE.csv [options]", 1, 1, run_sweep},
      "simulates a scenario with all combinations of values, on all cores; goes on where it ended",
      R"(A row a run: its values, the figures of `firmtouch-sim score`, how many of them miss
their bar, and the faults, a bit each. Rows stand in the order of the runs. Killed and
started again, it goes on and writes the same bytes. On several machines: --shard 1/8 to
8/8 into a file each, then `firmtouch-sim merge`; tools/batch has a make file and a
SLURM script for that.)",
      {{"--vary", "KEY=V,V,...",
        "values of a scenario's line, with unit: \"mass=60 g,75 g\"; evenly:\n"
        "                              \"hand_stiffness=100..1000:10 N/m\"; may be repeated",
        true},
       {"-o", "FILE.csv", "the results"},
       {"--shard", "I/N", "every Nth run only, from the Ith on"},
       {"--jobs", "N", "threads (default: one a core)"},
       {"--penalty", nullptr, "penalty contact instead of a proxy, for comparison"}}};
}

cli::Command merge_command() {
  return {{"merge", "SHARD.csv... -o FILE.csv", 1, SIZE_MAX, merge_sweep},
          "puts the results of a sweep's or a catalogue's shards together, as one would have "
          "written them",
          "Refuses results of different batches, and names a run that is missing or there twice.",
          {{"-o", "FILE.csv", "the results of all"}}};
}

}  // namespace firmtouch::host_sim
