// The whole tick over a baked asset: contact, guide, faults, budgets, and that it is a function.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "bake/asset_writer.hpp"
#include "bake/bake_curve.hpp"
#include "bake/bake_mesh.hpp"
#include "bake/probes.hpp"
#include "firmtouch/controller.hpp"
#include "firmtouch/curve/layout.hpp"
#include "firmtouch/servo/fault.hpp"
#include "harness/test.hpp"
#include "surface/make_part.hpp"

namespace asset = firmtouch::asset;
namespace core = firmtouch::core;
namespace curve = firmtouch::curve;
namespace mesh = firmtouch::mesh;
namespace params = firmtouch::params;
namespace record = firmtouch::record;
namespace servo = firmtouch::servo;
namespace tools = firmtouch::tools;

using firmtouch::Controller;
using firmtouch::Selection;

namespace {

// An asset in memory at an address that is a multiple of 16.
struct Asset {
  std::vector<uint8_t> storage;
  uint8_t* begin = nullptr;
  uint32_t size = 0;
  explicit Asset(const std::vector<uint8_t>& bytes) : storage(bytes.size() + 16) {
    const auto address = reinterpret_cast<uintptr_t>(storage.data());
    begin = storage.data() + (16 - address % 16) % 16;
    size = static_cast<uint32_t>(bytes.size());
    std::memcpy(begin, bytes.data(), bytes.size());
  }
  Asset(const Asset&) = delete;
  core::Bytes bytes() const { return {begin, size}; }
};

std::vector<tools::Section> part_sections() {
  tools::MeshReport report;
  std::vector<tools::Section> sections = tools::bake_mesh(tools::make_part(1, 4000), "part", {}, report);
  CHECK(report.problem.empty());
  mesh::View view;
  CHECK(mesh::open(tools::mesh_sections(sections, "part"), view).ok());
  sections.push_back(tools::mesh_probes(view, "part"));
  return sections;
}

std::vector<tools::Section> path_sections() {
  tools::CurvePoints points;
  points.samples_m = tools::make_path(1, 400);
  for (uint32_t i = 0; i < points.samples_m.size(); ++i) points.rows.push_back(i);
  tools::CurveReport report;
  std::vector<tools::Section> sections = tools::bake_curve(points, "path", report);
  CHECK(report.problem.empty());
  curve::View view;
  CHECK(curve::open(tools::curve_sections(sections, "path"), view).ok());
  sections.push_back(tools::curve_probes(view, "path"));
  return sections;
}

std::vector<uint8_t> file_of(std::vector<tools::Section> sections) {
  const tools::AssetFile file = tools::write_asset(std::move(sections));
  CHECK(file.problem.empty());
  return file.bytes;
}

const Asset& both() {
  static const Asset made([] {
    std::vector<tools::Section> sections = part_sections();
    for (tools::Section& section : path_sections()) sections.push_back(std::move(section));
    return file_of(std::move(sections));
  }());
  return made;
}

// A tool that follows the guide's samples while it bobs up and down, so that it is in contact, on the guide, and free.
struct Ride {
  Controller controller;
  record::TickInput input{};
  record::TickOutput output{};
  std::vector<firmtouch::math::Vec3> path = tools::make_path(1, 400);
  explicit Ride(const Asset& from = both(), Selection selection = {}) {
    CHECK_EQ(controller.open(from.bytes(), selection).rule, 0u);
  }

  void fill(uint32_t tick) {
    const double along = 0.02 * tick;
    const size_t i = static_cast<size_t>(along) % (path.size() - 1);
    const double t = along - std::floor(along);
    const double lift = 0.004 * std::sin(0.011 * tick) - 0.001;
    const auto mix = [t](float a, float b) { return static_cast<double>(a) * (1 - t) + static_cast<double>(b) * t; };
    const double p_m[3] = {mix(path[i].x, path[i + 1].x), mix(path[i].y, path[i + 1].y),
                           mix(path[i].z, path[i + 1].z) + lift};
    input = {};
    input.tick = tick;
    input.clock_us = 4294900000u + tick * 1000u;  // wraps early on
    input.lines = tick < 10 ? 0 : record::kLineEnable;
    for (int k = 0; k < 3; ++k) input.encoder_counts[k] = static_cast<int32_t>(std::lround(p_m[k] * 100000));
  }
  void step() { controller.tick(input, output); }
  void run(uint32_t from, uint32_t to) {
    for (uint32_t tick = from; tick < to; ++tick) fill(tick), step();
  }
};

double size_of(const float (&a)[3]) {
  return std::hypot(static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2]));
}

bool all_finite(const record::TickOutput& output) {
  const float* at = output.motor_N;
  for (int k = 0; k < 17; ++k) {
    if (!std::isfinite(at[k])) return false;
  }
  return true;
}

}  // namespace

TEST(RideOnThePartIsFeltAndKeepsEveryLimit) {
  Ride ride;
  uint32_t contact = 0, guide = 0, late_steps = 0;
  double before[3] = {};
  for (uint32_t tick = 0; tick < 6000; ++tick) {
    ride.fill(tick);
    ride.step();
    const record::TickOutput& o = ride.output;
    CHECK(all_finite(o));
    CHECK_LE(size_of(o.motor_N), 8.0);
    double change2 = 0;
    for (int k = 0; k < 3; ++k) {
      const double now = static_cast<double>(o.motor_N[k]);
      change2 += (now - before[k]) * (now - before[k]);
      before[k] = now;
    }
    CHECK_LE(std::sqrt(change2), 5.0);
    CHECK_LE(o.distance_lower_m, std::fabs(o.distance_m));
    contact += (o.state & record::kStateContact) != 0 ? 1 : 0;
    guide += (o.state & record::kStateOnGuide) != 0 ? 1 : 0;
    if (tick > 10 && o.steps > 200) ++late_steps;
  }
  CHECK_EQ(ride.output.faults, 0u);
  CHECK_GE(contact, 1000u);
  CHECK_GE(guide, 3000u);
  CHECK_LT(contact, 6000u);
  CHECK_EQ(late_steps, 0u);
}

TEST(SameInputsTwiceGiveTheSameBits) {
  Ride a, b;
  uint32_t differ = 0;
  for (uint32_t tick = 0; tick < 3000; ++tick) {
    a.fill(tick);
    b.input = a.input;
    a.step();
    b.step();
    if (std::memcmp(&a.output, &b.output, sizeof a.output) != 0) ++differ;
  }
  CHECK_EQ(differ, 0u);
  // And after a reset, as from the beginning.
  a.controller.reset();
  Ride fresh;
  for (uint32_t tick = 0; tick < 500; ++tick) {
    a.fill(tick);
    fresh.input = a.input;
    a.step();
    fresh.step();
    if (std::memcmp(&a.output, &fresh.output, sizeof a.output) != 0) ++differ;
  }
  CHECK_EQ(differ, 0u);
}

TEST(TwoControllersInOneProcessDoNotMeet) {
  Ride a, alone, other;
  uint32_t differ = 0;
  for (uint32_t tick = 0; tick < 1500; ++tick) {
    a.fill(tick);
    alone.input = a.input;
    other.fill(7 * tick + 3);
    other.input.command = 1 + params::kContactStiffness;
    other.input.command_value = static_cast<float>(tick);
    a.step();
    other.step();
  }
  alone.run(0, 1500);
  if (std::memcmp(&a.output, &alone.output, sizeof a.output) != 0) ++differ;
  CHECK_EQ(differ, 0u);
}

TEST(EachLineAndEachBrokenInputLatchesItsFaultInTime) {
  struct Plan {
    const char* name;
    uint32_t fault, within_ticks;
    void (*bend)(record::TickInput& input, uint32_t since);
  };
  const Plan plans[] = {
      {"emergency stop", servo::kFaultEmergencyStop, 1,
       [](record::TickInput& i, uint32_t since) { if (since == 0) i.lines |= record::kLineEmergencyStop; }},
      {"drive", servo::kFaultDrive, 1,
       [](record::TickInput& i, uint32_t since) { if (since == 0) i.lines |= record::kLineDriveFault; }},
      {"encoder lost", servo::kFaultEncoder, 3,
       [](record::TickInput& i, uint32_t) { i.lines |= record::kLineEncoderFault; }},
      {"encoder jump", servo::kFaultEncoder, 3,
       [](record::TickInput& i, uint32_t since) { i.encoder_counts[1] += since % 2 == 0 ? 200000 : -200000; }},
      {"clock stands", servo::kFaultClock, 4,
       [](record::TickInput& i, uint32_t since) { i.clock_us -= 1000u * since; }},
      {"clock set back", servo::kFaultClock, 1, [](record::TickInput& i, uint32_t) { i.clock_us -= 50000u; }},
      {"three late ticks", servo::kFaultDeadline, 3,
       [](record::TickInput& i, uint32_t since) { i.clock_us += 1000u * (since + 1); }},
      {"stall", servo::kFaultDeadline, 1, [](record::TickInput& i, uint32_t) { i.clock_us += 5000u; }},
      {"out of reach", servo::kFaultWorkspace, 120,
       [](record::TickInput& i, uint32_t since) { i.encoder_counts[0] += 450 * static_cast<int32_t>(since); }},
  };
  for (const Plan& plan : plans) {
    for (const uint32_t at : {300u, 517u, 801u, 1103u}) {
      Ride ride;
      ride.run(0, at);
      CHECK_EQ(ride.output.faults, 0u);
      uint32_t latched = UINT32_MAX;
      for (uint32_t since = 0; since < 140; ++since) {
        ride.fill(at + since);
        plan.bend(ride.input, since);
        ride.step();
        CHECK(all_finite(ride.output));
        CHECK_LE(size_of(ride.output.motor_N), 8.0);
        if (ride.output.faults != 0 && latched == UINT32_MAX) latched = since;
        if (latched != UINT32_MAX && since >= latched + 10) CHECK_EQ(size_of(ride.output.motor_N), 0.0);
      }
      firmtouch::test::note(plan.name, at);
      CHECK_LT(latched, plan.within_ticks);
      CHECK_NE(ride.output.faults & plan.fault, 0u);
      CHECK_EQ(ride.output.faults & servo::kFaultGuard, 0u);  // servo itself was enough
    }
  }
}

TEST(ClearedFaultsLetItGoOn) {
  Ride ride;
  ride.run(0, 400);
  ride.fill(400);
  ride.input.lines |= record::kLineEmergencyStop;
  ride.step();
  ride.run(401, 500);
  CHECK_EQ(ride.output.faults, servo::kFaultEmergencyStop);
  ride.fill(500);
  ride.input.command = record::kCommandClearFaults;
  ride.step();  // refused: enable is high
  CHECK_NE(ride.output.state & record::kStateCommandRefused, 0u);
  CHECK_NE(ride.output.faults, 0u);
  ride.fill(501);
  ride.input.lines = 0;
  ride.input.command = record::kCommandClearFaults;
  ride.step();
  CHECK_EQ(ride.output.faults, 0u);
  double most = 0;
  for (uint32_t tick = 502; tick < 1500; ++tick) {
    ride.fill(tick);
    ride.step();
    most = std::fmax(most, size_of(ride.output.motor_N));
  }
  CHECK_EQ(ride.output.faults, 0u);
  CHECK_GE(most, 0.3);
}

TEST(RandomInputsNeverBreakTheOutput) {
  Ride ride;
  uint64_t word = 1;
  const auto random = [&word] {
    word = word * 6364136223846793005ull + 1442695040888963407ull;
    return static_cast<uint32_t>(word >> 32);
  };
  double before[3] = {};
  for (uint32_t tick = 0; tick < 20000; ++tick) {
    ride.fill(tick);
    const uint32_t what = random() % 40;
    if (what == 0) ride.input.encoder_counts[random() % 3] = static_cast<int32_t>(random());
    if (what == 1) ride.input.clock_us = random();
    if (what == 2) ride.input.lines = random() & 0xFu;
    if (what == 3) ride.input.tick = random();
    if (what == 4 || what == 5) {
      ride.input.command = 1 + random() % (params::kCount + 1);
      const uint32_t bits = random();
      std::memcpy(&ride.input.command_value, &bits, 4);
    }
    if (what == 6) ride.input.command = record::kCommandClearFaults, ride.input.lines = 0;
    const double slew_N = static_cast<double>(ride.controller.values()[params::kSlewLimit]) *
                          static_cast<double>(ride.controller.values()[params::kTickPeriod]);
    ride.step();
    CHECK(all_finite(ride.output));
    const double limit_N = static_cast<double>(ride.controller.values()[params::kForceLimit]);
    CHECK_LE(size_of(ride.output.motor_N), limit_N);
    const double slew_now_N = static_cast<double>(ride.controller.values()[params::kSlewLimit]) *
                              static_cast<double>(ride.controller.values()[params::kTickPeriod]);
    for (int k = 0; k < 3; ++k) {
      const double now = static_cast<double>(ride.output.motor_N[k]);
      const double from = now * before[k] > 0 ? std::fabs(before[k]) : 0;
      CHECK_LE(std::fabs(now), from + std::fmax(slew_N, slew_now_N) * (1 + 1e-6) + 1e-6);
      before[k] = now;
    }
  }
}

TEST(AssetOfAMeshAloneOrACurveAloneWorks) {
  const Asset mesh_only(file_of(part_sections())), curve_only(file_of(path_sections()));
  Ride part(mesh_only), path(curve_only);
  part.run(0, 600);
  path.run(0, 600);
  CHECK(part.controller.mesh().is_open() && !part.controller.curve().is_open());
  CHECK(!path.controller.mesh().is_open() && path.controller.curve().is_open());
  CHECK_EQ(part.output.guide_deviation_m, 0.0f);
  CHECK_NE(part.output.distance_m, 0.0f);
  CHECK_EQ(path.output.distance_m, 0.0f);
  CHECK_NE(path.output.state & record::kStateOnGuide, 0u);
  CHECK_EQ(part.output.faults | path.output.faults, 0u);
}

TEST(AssetsAreChosenByNameAndMissingOnesRefused) {
  Ride named(both(), {"part", "path"});
  CHECK(named.controller.is_ready());
  Controller controller;
  CHECK_EQ(controller.open(both().bytes(), {"pat", nullptr}).rule, firmtouch::kRuleNoSuchMesh);
  CHECK_EQ(controller.open(both().bytes(), {nullptr, "part"}).rule, firmtouch::kRuleNoSuchCurve);
  const Asset empty(file_of({{asset::kProvenanceSection, "x", {'y'}}}));
  CHECK_EQ(controller.open(empty.bytes()).rule, firmtouch::kRuleNothingToFeel);
}

TEST(OtherProbeAnswersKeepTheMotorsOff) {
  for (const uint32_t type : {mesh::kProbesSection, curve::kProbesSection}) {
    std::vector<tools::Section> sections = part_sections();
    for (tools::Section& section : path_sections()) sections.push_back(std::move(section));
    for (tools::Section& section : sections) {
      if (section.type == type) section.bytes[8] = static_cast<uint8_t>(section.bytes[8] ^ 1u);  // the hash
    }
    const Asset bent(file_of(std::move(sections)));
    Controller controller;
    const bool is_mesh = type == mesh::kProbesSection;
    CHECK_EQ(controller.open(bent.bytes()).rule, is_mesh ? firmtouch::kRuleMeshProbes : firmtouch::kRuleCurveProbes);
    record::TickInput input{};
    input.lines = record::kLineEnable;
    record::TickOutput output;
    controller.tick(input, output);
    CHECK_EQ(output.faults, servo::kFaultProbes);
    CHECK_EQ(size_of(output.motor_N), 0.0);
  }
}

TEST(OpeningInSmallSlicesWhileTicksRunEndsTheSame) {
  Controller controller;
  controller.begin(both().bytes());
  uint32_t slices = 0;
  Ride ride;
  record::TickOutput output;
  while (!controller.work(257)) {
    ++slices;
    ride.fill(slices);
    ride.input.lines = record::kLineEnable;
    controller.tick(ride.input, output);
    CHECK_EQ(size_of(output.motor_N), 0.0);
    CHECK_EQ(output.faults, 0u);
  }
  CHECK(controller.verdict().ok());
  CHECK_GE(slices, 100u);
  CHECK_EQ(controller.asset_crc(), ride.controller.asset_crc());
}
