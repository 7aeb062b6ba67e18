// Hands of recorded runs: their target, the run that they drive, and logs that are refused.
#include "host_sim/trace/recorded_hand.hpp"

#include <cmath>
#include <limits>
#include <string>

#include "harness/test.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/hand/hand.hpp"
#include "host_sim/part_asset.hpp"
#include "host_sim/trace/log.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace host_sim;   // NOLINT
using namespace test;       // NOLINT

namespace {

Trace run_of(const Scenario& scenario) {
  const host_sim::Session session(part_asset());
  const host_sim::Environment environment =
      host_sim::environment_of(*session.controller, scene_origin_m(scenario));
  return host_sim::run(scenario, *session.controller, environment, nullptr, {});
}

std::string refusal_of(const Log& log) {
  const std::string path = scratch() + "/bad_hand.ftl";
  write_log(path, log);
  try {
    host_sim::recorded_hand(path);
  } catch (const host_sim::Refused& refused) {
    return refused.what();
  }
  return "";
}

Log three_ticks() {
  Log log;
  log.records.resize(3);
  for (uint32_t i = 0; i < 3; ++i) log.records[i].input.clock_us = 0xFFFFFE00u + 1000 * i;
  return log;
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST(RecordedHand_Target_HoldsTheForceWhereTheToolWas) {
  Scenario scenario;
  scenario.hand.stiffness_N_per_m = 400;
  scenario.recorded = {
      {0, {0.1, 0, 0}, {}}, {1e-3, {0.1, 0, 0}, {0, 0, 4}}, {3e-3, {0.12, 0, 0}, {0, 0, 4}}};
  const auto target_m = [&](double time_s) {
    const host_sim::Environment environment;
    return host_sim::Hand(scenario, environment, 0.003).target_m(time_s - 0.024);
  };
  CHECK_LE(norm(target_m(-1) - Vec{0.1, 0, 0}), 1e-15);
  CHECK_LE(norm(target_m(0.5e-3) - Vec{0.1, 0, -0.005}), 1e-15);
  CHECK_LE(norm(target_m(2e-3) - Vec{0.11, 0, -0.01}), 1e-15);
  CHECK_LE(norm(target_m(9) - Vec{0.12, 0, -0.01}), 1e-15);
  scenario.hand.mass_kg = 1, scenario.hand.arm_stiffness_N_per_m = 100;  // in series
  CHECK_LE(norm(target_m(9) - Vec{0.12, 0, -0.05}), 1e-15);
}

// The same hand by its script and by the record, on the same device and on one of twice its mass.
TEST(RecordedHand_DrivesARunAsItsScriptDid) {
  Scenario scenario = loop_scenario();
  const Trace scripted = run_of(scenario);
  Log log;
  log.records = scripted.records;
  const std::string path = scratch() + "/hand.ftl";
  write_log(path, log);
  scenario.moves.clear();
  scenario.recorded = host_sim::recorded_hand(path);
  for (const double mass_kg : {0.075, 0.15}) {
    scenario.device.mass_kg = mass_kg;
    const Trace again = run_of(scenario);
    CHECK_EQ(again.records.size(), scripted.records.size());
    double off2 = 0, way_m = 0, force_N = 0, want_N = 0;
    uint32_t touched = 0, want_touched = 0;
    for (size_t i = 0; i < again.records.size(); ++i) {
      const record::TickOutput &one = scripted.records[i].output, &other = again.records[i].output;
      const Vec off_m = host_sim::wide(other.position_m) - host_sim::wide(one.position_m);
      off2 += dot(off_m, off_m) / static_cast<double>(again.records.size());
      way_m = std::fmax(way_m, norm(host_sim::wide(one.position_m) -
                                    host_sim::wide(scripted.records[0].output.position_m)));
      force_N += norm(host_sim::wide(other.force_N)), want_N += norm(host_sim::wide(one.force_N));
      touched += (other.state & record::kStateContact) != 0;
      want_touched += (one.state & record::kStateContact) != 0;
    }
    firmtouch::test::note("rms of the way, 1e-4",
                          static_cast<int64_t>(std::sqrt(off2) / way_m * 1e4));
    CHECK_GE(want_touched, 2000u);
    CHECK_LE(std::fabs(1.0 * touched / want_touched - 1), 0.01);
    CHECK_LE(std::fabs(force_N / want_N - 1), 0.01);
    CHECK_LE(std::sqrt(off2), 0.01 * way_m);
  }
}

TEST(RecordedHand_LogsThatDriveNoHand_AreRefused) {
  CHECK(refusal_of(three_ticks()).empty());  // its clock wraps
  Log log = three_ticks();
  log.records[2].output.position_m[1] = std::numeric_limits<float>::quiet_NaN();
  CHECK(has(refusal_of(log), "bad_hand.ftl: at tick 0 position or force is not finite"));
  log = three_ticks();
  log.records[1].output.force_N[2] = std::numeric_limits<float>::infinity();
  CHECK(has(refusal_of(log), "not finite"));
  log = three_ticks();
  log.records[2].input.clock_us = log.records[1].input.clock_us;
  CHECK(has(refusal_of(log), "its clock stands or jumps"));
  log = three_ticks();
  log.records[2].input.clock_us -= 2000;
  CHECK(has(refusal_of(log), "its clock stands or jumps"));
  log = three_ticks();
  log.records[0].output.state = log.records[1].output.state = record::kStateNotHomed;
  CHECK(has(refusal_of(log), "no two ticks"));
  CHECK(has(refusal_of({}), "no two ticks"));
}
