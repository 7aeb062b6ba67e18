// The whole tick over a baked asset: contact, guide, budgets, opening, and that it is a function.
#include <cmath>
#include <cstdint>
#include <cstring>

#include "controller/ride.hpp"
#include "firmtouch/controller/full_controller.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/servo/fault.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace controller_test;

TEST(RideOnThePart_GivesForceAndKeepsEveryLimit) {
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
    // Up to four queries share the surface's budget.
    if (tick > 10 && o.steps > 500) ++late_steps;
  }
  CHECK_EQ(ride.output.faults, 0u);
  CHECK_GE(contact, 1000u);
  CHECK_GE(guide, 3000u);
  CHECK_LT(contact, 6000u);
  CHECK_EQ(late_steps, 0u);
}

TEST(SameInputsTwiceGiveTheSameBits) {
  Ride a, b;
  const auto fill = [](Ride& ride, uint32_t tick) { ride.fill(tick); };
  CHECK_EQ(differing_ticks(a, b, 3000, fill), 0u);
  // And after a reset, as from the beginning.
  a.controller.reset();
  Ride fresh;
  CHECK_EQ(differing_ticks(a, fresh, 500, fill), 0u);
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
  FullController controller;
  CHECK_EQ(controller.open(both().bytes(), {"pat", nullptr}).rule, firmtouch::kRuleNoSuchSurface);
  CHECK_EQ(controller.open(both().bytes(), {nullptr, "part"}).rule, firmtouch::kRuleNoSuchGuide);
  const Asset empty(file_of({{asset::kProvenanceSection, "x", {'y'}}}));
  CHECK_EQ(controller.open(empty.bytes()).rule, firmtouch::kRuleEmptyScene);
}

TEST(OtherProbeAnswersKeepTheMotorsOff) {
  for (const uint32_t type : {mesh::kProbesSection, curve::kProbesSection}) {
    std::vector<tools::Section> sections = both_sections();
    for (tools::Section& section : sections) {
      if (section.type == type)
        section.bytes[8] = static_cast<uint8_t>(section.bytes[8] ^ 1u);  // the hash
    }
    const Asset bent(file_of(std::move(sections)));
    FullController controller;
    const bool is_mesh = type == mesh::kProbesSection;
    CHECK_EQ(controller.open(bent.bytes()).rule,
             is_mesh ? firmtouch::kRuleMeshProbes : firmtouch::kRuleCurveProbes);
    CHECK_EQ(faults_when_enabled(controller), servo::kFaultProbes);
  }
}

TEST(MoreProbesThanASliceMayRunAreRefused) {
  for (const uint32_t count : {256u, 257u}) {
    std::vector<tools::Section> sections = part_sections();
    mesh::View view;
    CHECK(tools::open_baked(sections, "part", view).ok());
    sections.pop_back();
    std::vector<firmtouch::query::ProbePoint> points;
    for (uint32_t i = 0; i < count; ++i)
      points.push_back({0.001f * static_cast<float>(i), 0, 0.01f});
    const uint64_t hash = mesh::probe_hash(view, {points.data(), count});
    sections.push_back(tools::probe_section(mesh::kProbesSection, "part", points, hash));
    const Asset many(file_of(std::move(sections)));
    FullController controller;
    CHECK_EQ(controller.open(many.bytes()).rule,
             count == 256 ? 0u : uint32_t{firmtouch::kRuleMeshProbes});
  }
}

TEST(Opening_EverySliceStaysSmall) {
  FullController controller;
  controller.begin(both().bytes());
  uint32_t slices = 0;
  while (!controller.work(4096)) {
    ++slices;
    CHECK(controller.verdict().ok());  // nothing is said before it is finished
  }
  CHECK(controller.verdict().ok());
  CHECK_GE(slices, both().size / 4096 + controller.mesh().head().triangle_count / 256);
}

TEST(Opening_InSlicesBetweenTicks_GivesTheSameResult) {
  FullController controller;
  controller.begin(both().bytes());
  uint32_t slices = 0;
  Ride ride;
  record::TickOutput output;
  while (!controller.work(257)) {
    ++slices;
    ride.fill(slices);
    ride.input.flags = record::kFlagEnable;
    controller.tick(ride.input, output);
    CHECK_EQ(size_of(output.motor_N), 0.0);
    CHECK_EQ(output.faults, 0u);
  }
  CHECK(controller.verdict().ok());
  CHECK_GE(slices, 100u);
  CHECK_EQ(controller.asset_crc(), ride.controller.asset_crc());
}
