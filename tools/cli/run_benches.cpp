#include "cli/run_benches.hpp"

#include <algorithm>
#include <cstdio>

#include "bench/problem.hpp"
#include "cli/failure.hpp"
#include "cli/progress.hpp"
#include "json/json.hpp"

namespace firmtouch::cli {
namespace {

using Benches = std::vector<bench::Bench>;

constexpr size_t kNameWidth = 20;

std::string list_text(const Benches& all) {
  std::string text;
  for (const bench::Bench& each : all) {
    std::string line = std::string("  ") + each.name;
    line.resize(std::max(line.size() + 2, kNameWidth), ' ');
    text += line + each.summary + "\n";
  }
  return text;
}

std::string head_json(const bench::Bench& each) {
  return "{\"name\": " + tools::json_text(each.name) +
         ", \"summary\": " + tools::json_text(each.summary);
}

int list_benches(const Benches& all, bool is_json) {
  if (!is_json) {
    std::fputs(list_text(all).c_str(), stdout);
    return kDone;
  }
  std::string text;
  for (const bench::Bench& each : all)
    text += (text.empty() ? "\n  " : ",\n  ") + head_json(each) + "}";
  std::printf("{\"benches\": [%s\n]}\n", text.c_str());
  return kDone;
}

Benches chosen(const Benches& all, const std::string& name) {
  if (name == "all") return all;
  for (const bench::Bench& each : all)
    if (name == each.name) return {each};
  fail_usage("bench: '" + name + "' is no bench; there are\n" + list_text(all));
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

std::vector<Option> options_of_benches(std::vector<Option> own) {
  std::vector<Option> options = {{"--peer", "COMMAND", "what to race against (default: none)"},
                                 {"--bar", nullptr, "exit code 1 where a bar is not met"},
                                 {"--json", nullptr, "for programs"},
                                 {"--long", nullptr, "the full sizes"}};
  options.insert(options.begin() + 2, own.begin(), own.end());
  return options;
}

int run_benches(const std::vector<bench::Bench>& all, const Arguments& arguments) {
  const std::vector<std::string>& words = arguments.positionals();
  const bool is_json = arguments.has("--json");
  if (words.empty()) return list_benches(all, is_json);
  bench::Options options;
  options.models.assign(words.begin() + 1, words.end());
  options.peer = arguments.text("--peer", "");
  options.figures = arguments.text("--figures", "");
  options.is_long = arguments.has("--long");
  options.ticks = arguments.count("--ticks", 0, 1, UINT32_MAX);
  options.seed = arguments.count("--seed", 0, 0, UINT32_MAX);
  options.is_release = arguments.has("--release");
  size_t not_met = 0;
  std::string text;
  for (const bench::Bench& each : chosen(all, words[0])) {
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
