// What is gathered while a run goes on: bounded by design, whatever its duration.
#include <cmath>

#include "chart/envelope.hpp"
#include "harness/test.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/part_asset.hpp"
#include "host_sim/report/run_charts.hpp"
#include "host_sim/report/scene3d.hpp"

namespace host_sim = firmtouch::host_sim;
using firmtouch::chart::Envelope;
using host_sim::RunCharts;
using host_sim::RunFacts;
using host_sim::RunPaths;
using host_sim::RunTick;

namespace {

// Ticks without a simulation: a force of 1 N, and 5 N in the ticks of `event`.
RunTick tick_of(uint32_t number, uint32_t event, uint32_t event_ticks) {
  RunTick tick;
  tick.record.input.tick = number;
  tick.record.output.force_N[2] = number >= event && number < event + event_ticks ? 5.0f : 1.0f;
  tick.record.output.state = 2;
  return tick;
}

}  // namespace

TEST(Envelope_KeepsLeastAndGreatestOfEachBin) {
  Envelope line(2, false);
  for (const double value : {3.0, -1.0, 2.0}) line.add(0, value);
  line.add(0, NAN);
  line.add(0, 1e31);
  CHECK(line.values().size() == 4 && !(line.values()[0] > -1) && !(line.values()[1] < 3));
  CHECK(std::isnan(line.values()[2]) && std::isnan(line.values()[3]));
}

// 3 ms in 12 s at 1 kHz: every tick has a bin of its own.
TEST(Charts_TwelveSeconds_KeepEveryTick) {
  const host_sim::Environment environment;
  RunFacts facts;
  facts.ticks = 12000;
  RunCharts charts(environment, facts);
  for (uint32_t i = 0; i < facts.ticks; ++i) charts.add(tick_of(i, 7000, 3));
  charts.finish({});
  const std::vector<float>& force = charts.charts().front().curves.back().values.low();
  CHECK_EQ(force.size(), 12000u);
  size_t high = 0;
  for (const float value : force) high += value > 4 ? 1u : 0u;
  CHECK_EQ(high, 3u);
  CHECK(force[6999] < 2 && force[7000] > 4 && force[7002] > 4 && force[7003] < 2);
}

TEST(Charts_LongRun_IsBoundedAndKeepsTheEvent) {
  const host_sim::Environment environment;
  RunFacts facts;
  facts.ticks = 600000;
  RunCharts charts(environment, facts);
  RunPaths paths(environment, {}, facts);
  for (uint32_t i = 0; i < facts.ticks; ++i) {
    const RunTick tick = tick_of(i, 333333, 3);
    charts.add(tick);
    paths.add(tick);
  }
  charts.finish({});
  CHECK_LE(charts.bins(), RunCharts::kMaxBins);
  CHECK_LE(paths.samples().size(), 6000u);
  const std::vector<float>& greatest = charts.charts().front().curves.back().values.high();
  CHECK(4.0f < greatest[333333 / charts.ticks_per_bin()]);
  CHECK_LT(4.9, paths.peak_N());
}

// Homing lengthens a run while it goes on: the charts hold all of it, and no more.
TEST(Charts_RunLengthenedByHoming_HoldEveryTick) {
  const host_sim::Environment environment;
  for (const uint32_t spare_ticks : {10000u, 100000u}) {
    RunFacts facts;
    facts.ticks = 4000, facts.spare_ticks = spare_ticks;
    RunCharts charts(environment, facts);
    RunPaths paths(environment, {}, facts);
    const uint32_t ticks = facts.ticks + facts.spare_ticks * 9 / 10;
    for (uint32_t i = 0; i < ticks; ++i) {
      if (i >= 100 && facts.ticks < ticks) ++facts.ticks, --facts.spare_ticks;
      const RunTick tick = tick_of(i, ticks - 2, 2);
      charts.add(tick);
      paths.add(tick);
    }
    charts.finish({});
    const Envelope& force = charts.charts().front().curves.back().values;
    CHECK_LE(charts.bins(), RunCharts::kMaxBins);
    CHECK_EQ(charts.bins(), (ticks - 1) / charts.ticks_per_bin() + 1);
    CHECK_EQ(force.low().size(), charts.bins());
    CHECK_LT(4.0, force.values().back());
    CHECK_LE(paths.samples().size(), 6000u);
    const double length_s = charts.axis().seconds - ticks / facts.rate_Hz;
    CHECK(length_s >= 0 && length_s < charts.ticks_per_bin() / facts.rate_Hz);
  }
}

// A contact that opens and closes at every other tick would make 300,000 spans.
TEST(Charts_FlickeringContact_SpansAreBounded) {
  const host_sim::Environment environment;
  RunFacts facts;
  facts.ticks = 600000;
  RunCharts charts(environment, facts);
  for (uint32_t i = 0; i < facts.ticks; ++i) {
    RunTick tick = tick_of(i, 0, 0);
    if (i % 400 < 200) tick.record.output.state |= firmtouch::record::kStateContact;
    charts.add(tick);
  }
  CHECK_LE(charts.axis().contact_s.size(), 4096u);
}
