// Two runs compared: each difference is found where it was planted.
#include "host_sim/report/comparison.hpp"

#include <cmath>

#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using host_sim::Comparison;
using host_sim::Log;

namespace {

Log log_of(uint32_t ticks) {
  Log log;
  log.text["surface"] = "part";
  for (uint32_t i = 0; i < ticks; ++i) {
    record::TickRecord record{};
    record.input.tick = i;
    record.output.force_N[2] = 0.5f;
    log.records.push_back(record);
  }
  return log;
}

}  // namespace

TEST(Compare_EqualRuns_DifferInNothing) {
  const Comparison same = compare(log_of(100), log_of(100));
  CHECK_EQ(same.fields.size(), size_t{0});
  CHECK_EQ(same.settings.size(), size_t{0});
  CHECK_EQ(same.ticks, uint64_t{100});
  CHECK_EQ(same.first.peak_force_N, 0.5);
}

TEST(Compare_FindsFieldTickSizeAndSetting) {
  const Log first = log_of(100);
  Log second = log_of(90);
  second.text["surface"] = "other";
  second.text["guide"] = "path";
  second.records[40].output.force_N[2] = 0.75f;
  second.records[50].output.force_N[2] = -1.5f;
  second.records[60].input.encoder_counts[1] = -7;
  second.records[70].output.distance_m = NAN;
  second.records[80].output.proxy_m[0] = -0.0f;  // differs in a bit alone
  const Comparison result = compare(first, second);
  CHECK_EQ(result.ticks, uint64_t{90});
  CHECK_EQ(result.settings.size(), size_t{2});
  CHECK_EQ(result.fields.size(), size_t{4});
  const host_sim::FieldComparison &counts = result.fields[0], &force = result.fields[1];
  CHECK(counts.name == "input.encoder_counts[1]");
  CHECK_EQ(counts.worst, 7.0);
  CHECK(force.name == "output.force_N[2]");
  CHECK_EQ(force.first_tick, 40u);
  CHECK_EQ(force.worst_tick, 50u);
  CHECK_EQ(force.worst, 2.0);
  CHECK_LE(std::fabs(force.rms - std::sqrt((0.0625 + 4) / 90)), 1e-12);
  CHECK(std::isinf(result.fields[2].worst));
  CHECK_LE(result.fields[3].worst, 0.0);
  CHECK_EQ(result.fields[3].first_tick, 80u);
  CHECK_EQ(result.second.peak_force_N, 1.5);
}
