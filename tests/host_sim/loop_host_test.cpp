// The closed loop in this process, its log and its replay.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "firmtouch/record/ring.hpp"
#include "firmtouch/servo/fault.hpp"
#include "harness/test.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/hand/hand.hpp"
#include "host_sim/part_asset.hpp"
#include "host_sim/plant/brute_force.hpp"
#include "host_sim/report/summary.hpp"
#include "host_sim/trace/log.hpp"
#include "host_sim/trace/replay.hpp"
#include "log/memory_sink.hpp"
#include "log/writer.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace host_sim;   // NOLINT
using namespace test;       // NOLINT

namespace {

struct Run {
  host_sim::Scenario scenario = loop_scenario();
  Session session{part_asset()};
  host_sim::Environment environment =
      host_sim::environment_of(*session.controller, scene_origin_m(scenario));
  Trace trace = host_sim::run(scenario, *session.controller, environment, nullptr, {});
};

const Run& the_run() {
  static const Run made;
  return made;
}

Log log_of(const Trace& trace) {
  Log log;
  log.text["asset"] = "part.fta";
  log.text["scenario"] = "two\nlines \\ and a backslash";
  log.records = trace.records;
  return log;
}

std::string refusal_of(const std::string& path) {
  try {
    host_sim::read_log(path);
  } catch (const host_sim::Refused& refused) {
    return refused.what();
  }
  return "";
}

}  // namespace

TEST(ClosedLoop_TouchesFollowsAndLatchesEmergencyStop) {
  const host_sim::Summary s = summarise(the_run().scenario, the_run().environment, the_run().trace);
  CHECK_GE(s.ticks, 10000u);
  CHECK_GE(s.contact_ticks, 2000u);
  CHECK_GE(s.guide_ticks, 2000u);
  CHECK_EQ(s.faults, servo::kFaultEmergencyStop);
  CHECK_LT(0.5, s.peak_force_N);
  CHECK_LE(s.peak_force_N, s.force_limit_N * (1 + 1e-6));
  CHECK_LE(s.worst_visits, s.budget_units);
  CHECK_EQ(s.wrong_bounds, 0u);
  CHECK_GE(s.checked_ticks, 1000u);
}

// After the emergency stop the hand sinks into the part; no figure includes that.
TEST(Summary_CountsContactOnlyWithMotorsOn) {
  const host_sim::Summary s = summarise(the_run().scenario, the_run().environment, the_run().trace);
  size_t contact = 0, later = 0;
  double deepest_m = 0, deepest_later_m = 0;
  for (const record::TickRecord& r : the_run().trace.records) {
    const bool touches = (r.output.state & record::kStateContact) != 0;
    const bool stopped = r.output.faults != 0;
    double& deepest = stopped ? deepest_later_m : deepest_m;
    deepest = std::max(deepest, static_cast<double>(r.output.penetration_m));
    (stopped ? later : contact) += touches ? 1 : 0;
  }
  CHECK_GE(later, 100u);
  CHECK_LT(deepest_m * 2, deepest_later_m);
  CHECK_EQ(s.contact_ticks, contact);
  CHECK(!(s.worst_penetration_m < deepest_m) && !(s.worst_penetration_m > deepest_m));
}

TEST(Run_SameScenario_SameRecords) {
  const Run again;
  CHECK_EQ(again.trace.records.size(), the_run().trace.records.size());
  CHECK(std::memcmp(again.trace.records.data(), the_run().trace.records.data(),
                    again.trace.records.size() * sizeof(record::TickRecord)) == 0);
}

TEST(Replay_ReproducesEveryBit) {
  const std::string path = scratch() + "/run.ftl";
  write_log(path, log_of(the_run().trace));
  const Log log = host_sim::read_log(path);
  CHECK(log.is_complete);
  CHECK(log.text.at("scenario") == "two\nlines \\ and a backslash");
  CHECK_EQ(log.records.size(), the_run().trace.records.size());
  const Session session(part_asset());
  CHECK(!replay(log, tick_of(*session.controller)));
}

// A log as a version without `field` wrote it.
std::string write_without(const std::string& field, const std::vector<record::TickRecord>& all) {
  log::Header header = host_sim::tick_header();
  const log::Field* found = header.find(field);
  CHECK(found != nullptr);
  const uint32_t at = found->offset;
  header.fields.erase(header.fields.begin() + (found - header.fields.data()));
  header.record_bytes = log::place(header.fields);
  log::MemorySink sink;
  log::Writer writer(sink, header);
  writer.begin();
  for (uint32_t i = 0; i < all.size(); ++i) {
    const record::Numbered<record::TickRecord> slot{i, all[i]};
    std::vector<uint8_t> bytes(sizeof slot);
    std::memcpy(bytes.data(), &slot, sizeof slot);
    bytes.erase(bytes.begin() + at, bytes.begin() + at + 4);
    writer.append(bytes.data(), 1);
  }
  writer.finish();
  const std::string path = scratch() + "/older.ftl";
  host_sim::write_file(path, {sink.bytes().begin(), sink.bytes().end()});
  return path;
}

TEST(Replay_LogOfAnOlderVersion_TakesWorkAsNotMeasured) {
  std::vector<record::TickRecord> records = the_run().trace.records;
  records.resize(3000);
  for (record::TickRecord& record : records) record.input.last_work_us = 7;
  const Log log = host_sim::read_log(write_without("input.last_work_us", records));
  CHECK(log.is_complete);
  CHECK_EQ(log.records.size(), records.size());
  for (const record::TickRecord& record : log.records) CHECK_EQ(record.input.last_work_us, 0u);
  const Session session(part_asset());
  CHECK(!replay(log, tick_of(*session.controller)));
  CHECK(refusal_of(write_without("input.clock_us", records)).find("input.clock_us") !=
        std::string::npos);
}

TEST(Replay_LoadOfATickIsAnInput) {
  Log log = log_of(the_run().trace);
  for (uint32_t tick = 2000; tick < 2003; ++tick) log.records[tick].input.last_work_us = 950;
  const Session session(part_asset());
  const std::optional<Difference> found = replay(log, tick_of(*session.controller));
  CHECK(found && found->tick == 2002);
}

TEST(Replay_PlantedDifference_ReportsTickAndField) {
  for (const host_sim::Field& field : host_sim::fields()) {
    if (field.name.compare(0, 7, "output.") != 0) continue;
    Log log = log_of(the_run().trace);
    log.records.resize(4000);
    reinterpret_cast<unsigned char*>(&log.records[3456])[field.offset] ^= 1;
    const Session session(part_asset());
    const std::optional<Difference> found = replay(log, tick_of(*session.controller));
    CHECK(found && found->tick == 3456 && found->field == field.name);
    CHECK(found && found->expected != found->found);
  }
}

TEST(Replay_OtherInputs_Differs) {
  Log log = log_of(the_run().trace);
  log.records[5000].input.encoder_counts[2] += 3;
  const Session session(part_asset());
  const std::optional<Difference> found = replay(log, tick_of(*session.controller));
  CHECK(found && found->tick >= 5000);
}

TEST(Log_AnyDamagedByte_IsDetected) {
  Log log = log_of(the_run().trace);
  log.records.resize(3);
  const std::string path = scratch() + "/damaged.ftl";
  write_log(path, log);
  const std::string whole = host_sim::read_file(path);
  for (size_t i = 0; i < whole.size(); ++i) {
    std::string bytes = whole;
    bytes[i] = static_cast<char>(bytes[i] ^ 0x10);
    host_sim::write_file(path, bytes);
    // A damaged header rejects the whole log, a damaged block only itself.
    if (refusal_of(path).empty()) CHECK(!host_sim::read_log(path).is_complete);
  }
}

TEST(Log_CutOff_KeepsCompleteBlocks) {
  const std::string path = scratch() + "/cut.ftl";
  write_log(path, log_of(the_run().trace));
  const std::string whole = host_sim::read_file(path);
  host_sim::write_file(path, whole.substr(0, whole.size() - 300000));
  const Log log = host_sim::read_log(path);
  CHECK(!log.is_complete);
  CHECK_LT(5000u, log.records.size());
  CHECK_EQ(log.records.size() % 512, 0u);
  host_sim::write_file(path, "no log at all");
  CHECK(refusal_of(path).find("this is no log") != std::string::npos);
}

TEST(Run_RejectedParameter_EndsWithItsName) {
  host_sim::Scenario scenario = loop_scenario();
  for (uint32_t i = 0; i < firmtouch::params::kCount; ++i)
    if (firmtouch::params::kTable[i].when == firmtouch::params::When::kMotorsOff) {
      scenario.events.insert(scenario.events.begin(),
                             {1.0, host_sim::Event::Kind::kSet, i,
                              static_cast<double>(firmtouch::params::kTable[i].initial)});
      break;
    }
  const Session session(part_asset());
  const host_sim::Environment environment = host_sim::environment_of(*session.controller, {});
  std::string message;
  try {
    host_sim::run(scenario, *session.controller, environment, nullptr, {});
  } catch (const host_sim::Refused& refused) {
    message = refused.what();
  }
  CHECK(message.find("rejects tick_period_s") != std::string::npos);
  CHECK(message.find("only while the motors are off") != std::string::npos);
}

Trace run_with(const std::string& events) {
  const Session session(part_asset());
  const host_sim::Environment environment = host_sim::environment_of(*session.controller, {});
  host_sim::Scenario scenario = host_sim::read_scenario(
      "clear.scenario", "asset part.fta\nduration 1 s\n" + events, {}, host_sim::parameter_rows());
  host_sim::complete(scenario);
  return host_sim::run(scenario, *session.controller, environment, nullptr, {});
}

// A momentary fault and a held emergency stop; the scenario clears both, and the loop continues.
TEST(Scenario_ClearsFaults_WhileDisabled) {
  const std::string stop = "at 0.3 s emergency_stop\nat 0.4 s release\n";
  const std::string clear = stop + "at 0.5 s disable\nat 0.6 s clear_faults\nat 0.7 s enable\n";
  const Trace trace = run_with(clear);
  CHECK_EQ(trace.records[450].output.faults, servo::kFaultEmergencyStop);  // latched
  CHECK_EQ(trace.records[600].input.command, record::kCommandClearFaults);
  CHECK_EQ(trace.records[650].output.faults, 0u);
  CHECK_EQ(trace.records.back().output.faults, 0u);
  CHECK_EQ(trace.records.back().output.state & record::kStateServoMask,
           static_cast<uint32_t>(servo::Mode::kOn));
  std::string message;
  try {
    run_with(stop + "at 0.6 s clear_faults\n");
  } catch (const host_sim::Refused& refused) {
    message = refused.what();
  }
  CHECK(message.find("only while disabled") != std::string::npos);
}

// The controller takes a setting a tick. Ticks that come sooner than its period count as early.
TEST(Run_OfAnyRateAndSettings_BeginsWithoutAFault) {
  const char* const settings[] = {"contact_stiffness 700 N/m", "contact_damping 1.5 N*s/m",
                                  "guide_stiffness 300 N/m",   "guide_damping 1.5 N*s/m",
                                  "tool_radius 2 mm",          "force_limit 5 N",
                                  "friction_static 0.2",       "friction_dynamic 0.1"};
  for (const char* rate : {"50 Hz", "2.1 kHz", "10 kHz"}) {
    std::string lines = "rate " + std::string(rate) + "\n";
    for (const char* setting : settings) {
      lines += std::string(setting) + "\n";
      const Trace trace = run_with(lines);
      CHECK_EQ(trace.records.back().output.faults, 0u);
      CHECK_EQ(trace.records.back().output.state & record::kStateServoMask,
               static_cast<uint32_t>(servo::Mode::kOn));
    }
  }
}

TEST(Scenario_Overload_IsAFaultAndTheReportSaysHowMuch) {
  const Trace trace = run_with("at 0.2 s load 0.8\nat 0.5 s load 1.2\n");
  CHECK_EQ(trace.records[499].output.faults, 0u);
  CHECK_EQ(trace.records[510].output.faults, servo::kFaultOverload);
  CHECK_EQ(trace.records.back().input.last_work_us, 0u);  // no tick queries any more
  const host_sim::Scenario scenario = loop_scenario();
  const Session session(part_asset());
  const host_sim::Summary summary =
      summarise(scenario, host_sim::environment_of(*session.controller, {}), trace);
  CHECK_EQ(summary.latched.size(), 1u);
  CHECK(std::string(summary.latched[0].name) == "overload" && !summary.latched[0].is_scripted);
  CHECK(load_text(summary) == "mean 24 %, worst 120 % of the period");
  CHECK(load_text(summarise(scenario, the_run().environment, the_run().trace)) ==
        "not measured (lock-step)");
}

// All were dated by the first.
TEST(Summary_SeveralFaults_EachHasItsOwnTime) {
  const Trace trace = run_with("at 0.2 s drive_fault\nat 0.5 s emergency_stop\n");
  const Session session(part_asset());
  const host_sim::Environment environment = host_sim::environment_of(*session.controller, {});
  const host_sim::Summary summary = summarise(loop_scenario(), environment, trace);
  CHECK_EQ(summary.faults, servo::kFaultDrive | servo::kFaultEmergencyStop);
  CHECK_EQ(summary.latched.size(), 2u);
  CHECK(std::string(summary.latched[0].name) == "drive");
  CHECK(std::string(summary.latched[1].name) == "emergency stop");
  CHECK(std::fabs(summary.latched[0].time_s - 0.2) < 0.002);
  CHECK(std::fabs(summary.latched[1].time_s - 0.5) < 0.002);
  CHECK(summary.latched[0].is_scripted && summary.latched[1].is_scripted);
  const std::string text = text_of(summary, trace);
  CHECK(text.find("\n  fault          drive, latched at 0.20") != std::string::npos);
  CHECK(text.find("\n  fault          emergency stop, latched at 0.50") != std::string::npos);
}

TEST(Session_DamagedAsset_ReportsRule) {
  std::string bytes = host_sim::read_file(part_asset());
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  const std::string path = scratch() + "/bent.fta";
  host_sim::write_file(path, bytes);
  std::string message;
  try {
    const Session session(path);
  } catch (const host_sim::Refused& refused) {
    message = refused.what();
  }
  CHECK(message.find("bent.fta: rejected by rule R") != std::string::npos);
}
