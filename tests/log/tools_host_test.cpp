#include <cmath>
#include <fstream>
#include <functional>

#include "harness/test.hpp"
#include "log/edit.hpp"
#include "log/file_sink.hpp"
#include "log/plot.hpp"
#include "log/sample_log.hpp"
#include "log/statistics.hpp"

// Statistics, cut, join and plot, over logs whose truth is known.
namespace firmtouch::log_test {
namespace {

// A servo's fields, little of them.
struct Tick {
  uint32_t number = 0;
  uint32_t clock_us = 0;
  float force_N[3] = {};
  float velocity_mps[3] = {};
  uint32_t steps = 0;
  uint32_t faults = 0;
};

log::Header tick_header() {
  log::Header made;
  made.fields = {{"number", "1", 1, 0, log::Type::kU32, 1, 0},
                 {"input.clock_us", "s", 1e-6, 0, log::Type::kU32, 1, 0},
                 {"output.force_N", "N", 1, 0, log::Type::kF32, 3, 0},
                 {"output.velocity_mps", "m/s", 1, 0, log::Type::kF32, 3, 0},
                 {"output.steps", "1", 1, 0, log::Type::kU32, 1, 0},
                 {"output.faults", "bits", 1, 0, log::Type::kU32, 1, 0}};
  made.record_bytes = log::place(made.fields);
  made.bits = {{"output.faults", 3, "deadline"}, {"output.faults", 31, "the last one"}};
  return made;
}

void write(const std::string& path, const std::vector<Tick>& ticks) {
  std::string problem;
  const auto sink = log::make_file(path, problem);
  log::Writer writer(*sink, tick_header());
  CHECK(writer.begin());
  for (size_t i = 0; i < ticks.size(); i += 100)
    CHECK(writer.append(reinterpret_cast<const uint8_t*>(&ticks[i]),
                        static_cast<uint32_t>(std::min<size_t>(100, ticks.size() - i))));
  CHECK(writer.finish());
}

// 1,000 ticks: 50 missing before 400, one of 1.7 ms before 600, a clock that wraps, two faults.
std::vector<Tick> sample_ticks() {
  std::vector<Tick> ticks;
  uint32_t clock_us = 0xFFFF0000u;
  for (uint32_t i = 0; i < 1000; ++i) {
    clock_us += i == 600 ? 1700 : 1000;
    if (i >= 350 && i < 400) continue;
    Tick tick;
    tick.number = i;
    tick.clock_us = clock_us;
    tick.force_N[0] = i == 700 ? -3.0f : 1.0f;
    tick.force_N[2] = i == 700 ? 4.0f : 0.0f;
    tick.velocity_mps[0] = 0.5f;
    tick.steps = i == 123 || i == 456 ? 777 : i % 10;
    tick.faults = (i >= 900 ? 1u << 3 : 0u) | (i >= 990 ? 1u << 31 : 0u);
    ticks.push_back(tick);
  }
  return ticks;
}

bool near(double a, double b) { return std::fabs(a - b) <= 1e-9 * std::fabs(b) + 1e-12; }

TEST(StatisticsReportWhatWasPlanted) {
  Folder folder;
  const std::string path = folder.name + "/a.ftl";
  write(path, sample_ticks());
  log::Reader reader(log::open_file(path), path);
  const log::Statistics s = log::statistics_of(reader);
  CHECK_EQ(s.records, 950u);
  CHECK_EQ(s.missing, 50u);
  CHECK_EQ(s.gaps.size(), 1u);
  CHECK_EQ(s.gaps[0].number, 400u);
  CHECK(near(s.seconds, 0.9997));
  CHECK_EQ(s.period.count, 948u);  // not across the gap
  CHECK(near(s.period.median_us, 1000) && near(s.period.min_us, 1000));
  CHECK(near(s.period.max_us, 1700));
  CHECK_EQ(s.period.max_number, 600u);
  CHECK(near(s.period.mean_us, 1000 + 700.0 / 948));
  CHECK(
      near(s.period.deviation_us, std::sqrt(700.0 * 700.0 / 948 - (700.0 / 948) * (700.0 / 948))));
  CHECK_EQ(s.worst_steps.size(), 5u);
  CHECK_EQ(s.worst_steps[0].number, 123u);
  CHECK_EQ(s.worst_steps[1].number, 456u);
  CHECK_EQ(s.worst_steps[1].steps, 777u);
  CHECK_EQ(s.worst_steps[2].number, 9u);
  CHECK(near(s.max_force_N, 5));
  CHECK_EQ(s.max_force_number, 700u);
  CHECK_EQ(s.faults.size(), 2u);
  CHECK(s.faults[0].what == "deadline" && s.faults[0].first_number == 900 &&
        s.faults[0].records == 100);
  CHECK(s.faults[1].what == "the last one" && s.faults[1].first_number == 990);
  CHECK(log::text_of(s).find("50 before record 400") != std::string::npos);
}

std::vector<uint32_t> numbers_of(const std::string& path, std::vector<uint8_t>& payload) {
  log::Reader reader(log::open_file(path), path);
  std::vector<uint32_t> numbers;
  log::Block block;
  while (reader.next(block)) {
    payload.insert(payload.end(), block.payload.begin(), block.payload.end());
    for (uint32_t i = 0; i < block.count; ++i) numbers.push_back(log::word(block.record(i), 0));
  }
  CHECK(reader.is_whole());
  return numbers;
}

TEST(PiecesJoinedAgainAreTheWhole) {
  Folder folder;
  const auto path = [&](const char* name) { return folder.name + "/" + name; };
  write(path("a.ftl"), sample_ticks());
  CHECK_EQ(log::cut(path("a.ftl"), 0, 133, path("1.ftl")), 133u);
  CHECK_EQ(log::cut(path("a.ftl"), 133, 390, path("2.ftl")), 217u);
  CHECK_EQ(log::cut(path("a.ftl"), 390, UINT64_MAX, path("3.ftl")), 600u);
  CHECK_EQ(log::join({path("1.ftl"), path("2.ftl"), path("3.ftl")}, path("b.ftl")), 950u);
  std::vector<uint8_t> whole, joined;
  CHECK(numbers_of(path("a.ftl"), whole) == numbers_of(path("b.ftl"), joined));
  CHECK(whole == joined);
  log::Reader reader(log::open_file(path("b.ftl")), "b");
  log::read_through(reader);
  CHECK_EQ(reader.missing(), 50u);
  CHECK_EQ(log::number_at(path("a.ftl"), 0.2), 200u);
  CHECK_EQ(log::number_at(path("a.ftl"), 0.37), 400u);  // inside of what is missing
  CHECK_EQ(log::number_at(path("a.ftl"), 9), 1000u);
}

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(UnrelatedLogs_AreRejected_NoFileIsLeft) {
  Folder folder;
  const auto path = [&](const char* name) { return folder.name + "/" + name; };
  write(path("a.ftl"), sample_ticks());
  log::cut(path("a.ftl"), 0, 100, path("1.ftl"));
  log::cut(path("a.ftl"), 100, 200, path("2.ftl"));
  CHECK(refusal([&] {
          log::join({path("2.ftl"), path("1.ftl")}, path("x.ftl"));
        }).find("name them in their order") != std::string::npos);
  std::ofstream(path("other.ftl"), std::ios::binary)
      .write(reinterpret_cast<const char*>(log_of({{200, 201}}).data()),
             static_cast<std::streamsize>(log_of({{200, 201}}).size()));
  CHECK(refusal([&] {
          log::join({path("1.ftl"), path("other.ftl")}, path("x.ftl"));
        }).find("of another kind") != std::string::npos);
  CHECK(refusal([&] {
          log::cut(path("a.ftl"), 5000, 6000, path("x.ftl"));
        }).find("no record has a number") != std::string::npos);
  CHECK(refusal([&] { log::cut(path("no.ftl"), 0, 1, path("x.ftl")); }).find("no.ftl") !=
        std::string::npos);
  for (const char* left : {"x.ftl", "x.ftl.partial"}) CHECK(!std::ifstream(path(left)).good());
}

size_t count(const std::string& text, const std::string& what) {
  size_t found = 0;
  for (size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
  return found;
}

TEST(Plot_MissingRecords_BreakTheLines) {
  Folder folder;
  const std::string path = folder.name + "/a.ftl";
  write(path, sample_ticks());
  const std::string svg = log::plot(path, {}, false);
  for (const char* title : {"Force at the tool", "Energy given to the hand", "Steps a tick",
                            "Speed", "Period of the ticks"})
    CHECK_GE(count(svg, title), 1u);
  CHECK_EQ(count(svg, "Position of the tool"), 0u);  // the log has none
  CHECK_EQ(count(svg, "50 missing in 1 place<"), 1u);
  CHECK_EQ(count(svg, "class=\"missing\""), 5u);
  CHECK_EQ(count(svg, "fault: deadline, from 0.90"), 1u);
  CHECK_EQ(count(svg, "fault: the last one"), 1u);
  CHECK_EQ(count(svg, "<polyline"), 10u);  // each of five lines in two pieces
  CHECK_EQ(count(svg, "<svg"), count(svg, "</svg>"));
  CHECK_EQ(count(svg, "var(--"), 0u);
  CHECK_EQ(count(svg, "nan"), 0u);
  const std::string page = log::plot(path, {"output.steps", "output.force_N"}, true);
  CHECK_EQ(count(page, "<polyline"), 8u);
  CHECK_GE(count(page, "50 before record 400"), 1u);
  CHECK_EQ(count(log::plot(path, {"output.faults"}, false), "fault: deadline"), 1u);  // in words
  CHECK(refusal([&] {
          log::plot(path, {"output.colour"}, false);
        }).find("no field output.colour") != std::string::npos);
}

TEST(RunThatStoodStillOrLostItsNumbers_IsDrawnWithANote) {
  Folder folder;
  const std::string path = folder.name + "/a.ftl";
  std::vector<Tick> ticks = sample_ticks();
  for (Tick& tick : ticks) {
    tick.steps = 0;
    tick.force_N[0] = tick.force_N[2] = tick.velocity_mps[0] = 0;
  }
  write(path, ticks);
  CHECK_EQ(count(log::plot(path, {}, false), "nan"), 0u);
  write(path, {ticks[3]});
  CHECK_EQ(count(log::plot(path, {}, false), "<circle"), 4u);  // a period takes two
  ticks[500].force_N[1] = std::nanf("");
  ticks[501].velocity_mps[2] = -INFINITY;
  write(path, ticks);
  const std::string svg = log::plot(path, {}, false);
  CHECK_EQ(count(svg, "nan") + count(svg, "inf"), 0u);
  CHECK_EQ(count(svg, "2 with values that are not finite"), 1u);
  log::Reader reader(log::open_file(path), path);
  const std::string reported = log::text_of(log::statistics_of(reader));
  CHECK_EQ(count(reported, "output.force_N[1]: first at record 550, in 2 records"), 1u);
}

}  // namespace
}  // namespace firmtouch::log_test
