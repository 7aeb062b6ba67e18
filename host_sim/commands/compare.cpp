#include <cstdio>

#include "device/refused.hpp"
#include "host_sim/commands/commands.hpp"
#include "host_sim/report/comparison.hpp"
#include "json/json.hpp"

namespace firmtouch::host_sim {
namespace {

void print(const char* name, double first, double second) {
  std::printf("%-22s %14.6g %14.6g %14.6g\n", name, first, second, second - first);
}

void print_figures(const RunFigures& a, const RunFigures& b) {
  const auto count = [](uint64_t value) { return static_cast<double>(value); };
  std::printf("%-22s %14s %14s %14s\n", "figure", "first", "second", "change");
  print("ticks", count(a.ticks), count(b.ticks));
  print("contact ticks", count(a.contact_ticks), count(b.contact_ticks));
  print("exact ticks", count(a.exact_ticks), count(b.exact_ticks));
  print("peak force, N", a.peak_force_N, b.peak_force_N);
  print("rms force, N", a.rms_force_N, b.rms_force_N);
  print("peak motor, N or N m", a.peak_motor, b.peak_motor);
  print("peak speed, m/s", a.peak_speed_mps, b.peak_speed_mps);
  print("deepest, mm", a.deepest_m * 1e3, b.deepest_m * 1e3);
  print("mean visits", a.mean_visits, b.mean_visits);
  print("worst visits", a.worst_visits, b.worst_visits);
  std::printf("%-22s     0x%08x     0x%08x\n", "faults", a.faults, b.faults);
}

std::string json_of(const RunFigures& run) {
  tools::Json object;
  object.add("ticks", run.ticks).add("contact_ticks", run.contact_ticks);
  object.add("exact_ticks", run.exact_ticks).add("peak_force_N", run.peak_force_N);
  object.add("rms_force_N", run.rms_force_N).add("peak_motor", run.peak_motor);
  object.add("peak_speed_mps", run.peak_speed_mps).add("deepest_m", run.deepest_m);
  object.add("mean_steps", run.mean_visits).add("worst_steps", uint64_t{run.worst_visits});
  return object.add("faults", uint64_t{run.faults}).object();
}

std::string json_of(const Comparison& result, bool is_same) {
  tools::Json all;
  all.add("is_equal", is_same).add("first", json_of(result.first));
  all.add("second", json_of(result.second));
  all.add("settings", tools::json_list(result.settings, tools::json_text));
  all.add("fields", tools::json_list(result.fields, [](const FieldComparison& field) {
            tools::Json row;
            row.add("name", tools::json_text(field.name)).add("worst", field.worst);
            row.add("worst_tick", uint64_t{field.worst_tick}).add("rms", field.rms);
            return row.add("first_tick", uint64_t{field.first_tick}).object();
          }));
  return all.object() + "\n";
}

int print_comparison(const cli::Arguments& options) {
  Log logs[2];
  bool is_whole = true;
  for (size_t i = 0; i < 2; ++i) {
    logs[i] = read_log(options.positionals()[i]);
    if (logs[i].decimation != 1 || logs[i].first_number != 0)
      throw tools::Refused(options.positionals()[i] +
                           ": it does not hold every tick from the first; record the run again");
    if (logs[i].is_complete) continue;
    is_whole = false;
    std::fprintf(stderr, "%s: %s; the %zu ticks before are compared\n",
                 options.positionals()[i].c_str(), logs[i].damage.c_str(), logs[i].records.size());
  }
  const Comparison result = compare(logs[0], logs[1]);
  const bool is_same = result.fields.empty() && result.first.ticks == result.second.ticks;
  if (options.has("--json")) {
    std::fputs(json_of(result, is_same && is_whole).c_str(), stdout);
    return is_same && is_whole ? 0 : 1;
  }
  print_figures(result.first, result.second);
  for (const std::string& line : result.settings) std::printf("setting  %s\n", line.c_str());
  if (!result.fields.empty())
    std::printf("%-26s %12s %12s %12s %12s\n", "field", "worst", "at tick", "rms", "first tick");
  for (const FieldComparison& row : result.fields)
    std::printf("%-26s %12.5g %12u %12.5g %12u\n", row.name.c_str(), row.worst, row.worst_tick,
                row.rms, row.first_tick);
  std::printf("%s\n", !is_same   ? "they differ"
                      : is_whole ? "the same in every bit of every tick"
                                 : "the same in every bit of the ticks before the damage");
  return is_same && is_whole ? 0 : 1;
}

}  // namespace

cli::Command compare_command() {
  return {{"compare", "A.ftl B.ftl", 2, 2, print_comparison},
          "compares two runs: the figures of both, settings and fields that differ, and where",
          R"(Ticks are matched by their number, up to the end of the shorter run. Exit code 0: all
bits of all ticks are the same; 1: they differ, or a log is damaged.)",
          {{"--json", nullptr, "the comparison as JSON"}}};
}

}  // namespace firmtouch::host_sim
