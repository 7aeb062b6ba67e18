#include <cstdio>

#include "bake/asset/json_text.hpp"
#include "bench/bench.hpp"
#include "bench/problem.hpp"
#include "cli/commands.hpp"
#include "cli/failure.hpp"
#include "cli/progress.hpp"

namespace firmtouch::cli {
namespace {

std::string list_text() {
  std::string text;
  for (const bench::Bench& each : bench::benches()) {
    std::string line = std::string("  ") + each.name;
    line.resize(line.size() < 14 ? 14 : line.size() + 2, ' ');
    text += line + each.summary + "\n";
  }
  return text;
}

std::string head_json(const bench::Bench& each) {
  return "{\"name\": " + tools::json_text(each.name) +
         ", \"summary\": " + tools::json_text(each.summary);
}

int list_benches(bool is_json) {
  if (!is_json) {
    std::fputs(list_text().c_str(), stdout);
    return kDone;
  }
  std::string text;
  for (const bench::Bench& each : bench::benches())
    text += (text.empty() ? "\n  " : ",\n  ") + head_json(each) + "}";
  std::printf("{\"benches\": [%s\n]}\n", text.c_str());
  return kDone;
}

std::vector<bench::Bench> chosen(const std::string& name) {
  if (name == "all") return bench::benches();
  for (const bench::Bench& each : bench::benches())
    if (name == each.name) return {each};
  fail_usage("bench: '" + name + "' is no bench; there are\n" + list_text());
}

bench::Report report_of(const bench::Bench& each, const bench::Options& options) {
  bench::Report report;
  Progress progress(0);
  report.on_stage = [&](const std::string& what) { progress.stage(what); };
  try {
    each.run(options, report);
  } catch (const bench::Problem& problem) {
    fail_input(std::string("bench ") + each.name + ": " + problem.what());
  }
  report.on_stage = nullptr;
  return report;
}

}  // namespace

const Command& bench_command() {
  static const Command command{
      "bench",
      "[NAME|all] [MODEL...] [options]",
      "Measures: the tables of the papers and the bars of the project.",
      "Without NAME: the benches there are. Without MODEL: the demo's part. Times are of one "
      "thread,\n"
      "in turn with the peer's in one run, medians of 5; only their ratio means something on "
      "another\n"
      "machine. A peer is another program that answers the same queries:\n"
      "    COMMAND closest|segment|polyline|spline FILE in.csv     prints `us_per_query X`",
      {{"--peer", "COMMAND", "what to race against (default: none)"},
       {"--bar", nullptr, "exit code 1 where a bar is not met"},
       {"--figures", "FOLDER", "splines: figures 7 to 11 drawn as SVG"},
       {"--json", nullptr, "for programs"},
       {"--long", nullptr, "the full sizes"}},
      0,
      SIZE_MAX};
  return command;
}

int run_bench(const Arguments& arguments) {
  const std::vector<std::string>& words = arguments.positionals();
  const bool is_json = arguments.has("--json");
  if (words.empty()) return list_benches(is_json);
  bench::Options options;
  options.models.assign(words.begin() + 1, words.end());
  options.peer = arguments.text("--peer", "");
  options.figures = arguments.text("--figures", "");
  options.is_long = arguments.has("--long");
  size_t not_met = 0;
  std::string text;
  for (const bench::Bench& each : chosen(words[0])) {
    const bench::Report report = report_of(each, options);
    not_met += report.bars_not_met();
    if (is_json) {
      text += (text.empty() ? "\n  " : ",\n  ") + head_json(each) + ",\n   " +
              bench::to_json_members(report) + "}";
    } else {
      std::fputs(bench::to_text(report).c_str(), stdout);
    }
  }
  if (is_json) std::printf("{\"benches\": [%s\n]}\n", text.c_str());
  if (not_met == 0 || !arguments.has("--bar")) return kDone;
  std::fflush(stdout);
  std::fprintf(stderr, "firmtouch: bench: %zu %s not met\n", not_met,
               not_met == 1 ? "bar" : "bars");
  return kAnswerIsNo;
}

}  // namespace firmtouch::cli
