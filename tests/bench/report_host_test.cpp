// What a report says, as text and as JSON.
#include <cmath>
#include <limits>
#include <set>
#include <string>

#include "bench/bench.hpp"
#include "bench/report.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch::bench;  // NOLINT: a test file

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

// Brackets match outside of strings, and strings end.
bool is_balanced(const std::string& json) {
  std::string open;
  bool in_string = false;
  for (size_t i = 0; i < json.size(); ++i) {
    const char c = json[i];
    if (in_string) {
      if (c == '\\') ++i;
      if (c == '"') in_string = false;
      continue;
    }
    if (c == '"') in_string = true;
    if (c == '{' || c == '[') open += c;
    if (c != '}' && c != ']') continue;
    if (open.empty() || open.back() != (c == '}' ? '{' : '[')) return false;
    open.pop_back();
  }
  return open.empty() && !in_string;
}

}  // namespace

TEST(ABarIsMetUpToItsGoal) {
  Report report;
  report.bar("a", "m", 0.25, "x", 0.25);
  CHECK(report.entries()[0].figure[0].ok());
  report.bar("b", "m", 0.2500001, "x", 0.25);
  CHECK(!report.entries()[1].figure[0].ok());
  report.bar_at_least("c", "m", 0.98, "", 0.98);
  CHECK(report.entries()[2].figure[0].ok());
  report.bar_at_least("d", "m", 0.97, "", 0.98);
  CHECK(!report.entries()[3].figure[0].ok());
  CHECK_EQ(report.bars_not_met(), size_t{2});
  const std::string text = to_text(report);
  CHECK(holds(text, "goal <= 0.2500  met"));
  CHECK(holds(text, "goal <= 0.2500  NOT MET"));
  CHECK(holds(text, "goal >= 0.9800  NOT MET"));
}

TEST(Nan_MeetsNoBar) {
  Report report;
  report.bar("a", "m", std::numeric_limits<double>::quiet_NaN(), "x", 1);
  report.bar_at_least("b", "m", std::numeric_limits<double>::quiet_NaN(), "x", 1);
  CHECK_EQ(report.bars_not_met(), size_t{2});
  CHECK(holds(to_json_members(report), "\"value\": null"));
}

TEST(WhatIsAbsentIsNoFailureAndSaysWhy) {
  Report report;
  report.absent("against the peer", "spot", "peer absent");
  CHECK_EQ(report.bars_not_met(), size_t{0});
  CHECK(holds(to_text(report), "peer absent"));
  CHECK(holds(to_json_members(report), "\"value\": null"));
}

TEST(JsonIsWellFormedWhateverTheWords) {
  Report report;
  report.heading("a \"heading\" [with] {brackets}\n");
  report.figure("back\\slash", "m\t", 1e-9, "\x01", "");
  report.bar("bar", "", 3, "x", 4);
  report.table({"a", "b\""}, {{"1", "{"}, {"2", "]"}});
  const std::string json = "{" + to_json_members(report) + "}";
  CHECK(is_balanced(json));
  CHECK(holds(json, "\\u0009") && holds(json, "\\u0001") && holds(json, "back\\\\slash"));
  CHECK(holds(json, "\"goal\": 4, \"goal_is\": \"at most\", \"ok\": true"));
  CHECK(holds(json, "\"heading\": \"a \\\"heading\\\" [with] {brackets}\\u000a\""));
  CHECK(is_balanced("{" + to_json_members(Report()) + "}"));
}

TEST(ColumnsOfATableAreAligned) {
  Report report;
  report.table({"name", "value"}, {{"a", "1"}, {"longer", "1000"}});
  CHECK(to_text(report) == "  name    value\n  a           1\n  longer   1000\n");
}

TEST(NumbersKeepTheDigitsThatMeanSomething) {
  CHECK(number_text(0) == "0");
  CHECK(number_text(36) == "36");
  CHECK(number_text(0.25) == "0.2500");
  CHECK(number_text(1448.26) == "1448.3");
  CHECK(number_text(123456.7) == "123457");
  CHECK(number_text(1.5e-7) == "1.500e-07");
  CHECK(number_text(-1) == "-1");
  CHECK(number_text(std::nan("")) == "nan");
}

TEST(EveryBenchHasAnOwnNameAndOneLine) {
  std::set<std::string> names{"all"};
  for (const Bench& bench : benches()) {
    CHECK(names.insert(bench.name).second);
    CHECK(bench.run != nullptr);
    const std::string summary = bench.summary;
    CHECK(!summary.empty() && summary.size() <= 80 && !holds(summary, "\n"));
  }
}
