// A tool of several spheres in a ready controller: force and torque as recorded, the handle that
// commands turn, energy, replay, two rates, and assets that it rejects.
#include <algorithm>
#include <random>

#include "controller/placed.hpp"
#include "firmtouch/controller/tool_controller.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/materials_layout.hpp"
#include "firmtouch/scene/objects_layout.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace controller_test;

namespace {

using Spheres = std::vector<scene::SphereLayout>;

constexpr float kRadius_m = 0.003f;
const Spheres kBar = {{{-0.01f, 0, 0}, kRadius_m}, {{0.01f, 0, 0}, kRadius_m}};

std::vector<uint8_t> scene_with(const Spheres& spheres) {
  std::vector<tools::Section> sections = box_sections("box");
  sections.push_back(tools::make_section(scene::kToolSection, "bar", spheres));
  return file_of(std::move(sections));
}

struct Handle : Placed<ToolController> {
  std::vector<record::TickRecord> records;
  uint32_t touched = 0;                         // ticks
  double given_J = 0, least_J = 0, most_J = 0;  // by contact; gained while nothing is stored

  explicit Handle(const Spheres& spheres) : Placed(scene_with(spheres)) {
    begin();
    set(params::kDeviceDamping, 0);
  }
  void ticked(const record::TickOutput& before) override {
    for (int k = 0; k < 3; ++k)
      given_J +=
          wide(before.force_N[k]) * (wide(output.position_m[k]) - wide(before.position_m[k]));
    if ((output.state & record::kStateContact) != 0) {
      ++touched;
    } else {
      most_J = std::max(most_J, given_J - least_J);
      least_J = std::min(least_J, given_J);
    }
    records.push_back({input, output});
  }
  bool turn(uint32_t axis, float angle_rad) {
    return takes(record::kCommandTurnTool + axis, angle_rad, place_m);
  }
};

constexpr math::Vec3 kAbove_m{0, 0, kHalf_m + kRadius_m + 0.01f};

math::Vec3 pressed(float deep_m, float x_m = 0) { return {x_m, 0, kHalf_m + kRadius_m - deep_m}; }

// A handle that something moves and turns at random, in and out of the box.
void wander(Handle& handle, uint32_t seed, uint32_t ticks) {
  std::mt19937 random(seed);
  const auto between = [&](double low, double high) {
    return static_cast<float>(low +
                              (high - low) * static_cast<double>(random() >> 5) / 134217728.0);
  };
  for (uint32_t i = 0; i < ticks; i += 100) {
    const uint32_t drawn = static_cast<uint32_t>(random() % 3);
    if (drawn == 0) CHECK(handle.turn(static_cast<uint32_t>(random() % 3), between(-0.6, 0.6)));
    const float x_m = between(-0.03, 0.03), y_m = between(-0.03, 0.03);
    handle.go({x_m, y_m, between(0.015, 0.035)}, 60);
    handle.stay(drawn == 1 ? 40 : 0);
  }
}

}  // namespace

TEST(Tool_BarOnABox_RecordsForceTorqueAndSphere) {
  Handle bar(kBar);
  bar.go(kAbove_m, 300);
  bar.go(pressed(0.002f), 300);
  bar.stay(100);
  CHECK_LE(std::fabs(wide(bar.output.force_N[2]) - 800 * 0.002), 0.008);
  CHECK_LE(std::fabs(wide(bar.output.torque_Nm[1])), 1e-4);
  CHECK_LE(std::fabs(wide(bar.output.penetration_m) - 0.002), 1e-5);
  bar.go(kAbove_m, 100);
  // The left sphere is beyond the edge.
  bar.go(pressed(-0.01f, -0.017f), 300);
  bar.go(pressed(0.002f, -0.017f), 300);
  bar.stay(100);
  CHECK_LE(std::fabs(wide(bar.output.force_N[2]) - 400 * 0.002), 0.004);
  CHECK_LE(std::fabs(wide(bar.output.torque_Nm[1]) + 0.01 * 400 * 0.002), 0.005 * 0.008);
  CHECK_EQ(bar.output.state >> record::kStateObjectShift & 31u, 2u);
  CHECK_EQ(bar.output.faults, 0u);
  bar.flags = record::kFlagEmergencyStop;
  bar.tick(bar.place_m);
  CHECK_EQ(bar.output.torque_Nm[1], 0.0f);  // without motors there is none
}

// What is given back on the way out is what went in: the observer holds back nothing.
TEST(Tool_OneOfTwoSpheresPressedDeep_ForceIsTheSameOnTheWayOut) {
  Handle bar(kBar);
  bar.go(kAbove_m, 100);
  bar.go(pressed(-0.01f, -0.017f), 100);
  double in_N = 0;
  for (uint32_t i = 0; i < 100; ++i) {
    bar.go(pressed(-0.01f + 0.0002f * static_cast<float>(i + 1), -0.017f), 10);
    if (i == 74) in_N = wide(bar.output.force_N[2]);
  }
  CHECK_LE(std::fabs(in_N - 400 * 0.005), 0.01);
  bar.go(pressed(0.005f, -0.017f), 250);
  CHECK_LE(std::fabs(wide(bar.output.force_N[2]) - in_N), 0.005);
  CHECK_EQ(bar.output.faults, 0u);
}

TEST(Tool_CommandsTurnTheHandle_AtALimitedRate_AndReplay) {
  Handle bar(kBar);
  bar.go(kAbove_m, 100);
  CHECK(bar.turn(1, 1.5707963f));
  bar.stay(300);
  // Upright: one sphere touches, 10 mm below the handle.
  bar.go(pressed(0.002f) + math::Vec3{0, 0, 0.01f}, 300);
  bar.stay(50);
  CHECK_LE(std::fabs(wide(bar.output.force_N[2]) - 400 * 0.002), 0.005);
  CHECK_LE(std::fabs(wide(bar.output.torque_Nm[1])), 1e-4);
  const float special[] = {7, -7, std::numeric_limits<float>::quiet_NaN(),
                           std::numeric_limits<float>::infinity()};
  for (const float angle_rad : special) CHECK(!bar.turn(0, angle_rad));
  for (const uint32_t axis : {3u, 4u, 0xFFu, 0x100u}) CHECK(!bar.turn(axis, 0));
  bar.flags = record::kFlagModelApart;
  CHECK(!bar.turn(0, 0.1f));  // at two rates the handle keeps its orientation
  bar.flags = 0;
  wander(bar, 1, 3000);
  static ToolController again;
  CHECK_EQ(again.open(bar.asset.bytes()).rule, 0u);
  uint32_t differing = 0;
  for (const record::TickRecord& record : bar.records) {
    record::TickOutput output;
    again.tick(record.input, output);
    differing += std::memcmp(&output, &record.output, sizeof output) != 0 ? 1u : 0u;
  }
  CHECK_EQ(differing, 0u);
}

// Whatever moves and turns the handle: contact gives at most the reservoir and its overdraft.
TEST(Tool_AnyPassiveHandAndTurn_GetsNoMoreThanTheReservoir) {
  const Spheres all = {{{-0.02f, 0, 0}, 0.002f}, {{0.02f, 0, 0}, 0.003f}, {{0, 0.02f, 0}, 0.004f},
                       {{0, -0.02f, 0}, 0},      {{0, 0, 0.01f}, 0.003f}, {{0, 0, -0.01f}, 0.003f}};
  for (const Spheres& spheres : {kBar, all}) {
    Handle handle(spheres);
    handle.set(params::kTickWork, 3000);
    handle.set(params::kMeshWork, 2600);
    handle.go(kAbove_m, 300);
    handle.least_J = handle.given_J;
    for (uint32_t seed = 0; seed < 60; ++seed) {
      wander(handle, seed, 300);
      handle.go(kAbove_m, 60);
    }
    CHECK_GE(handle.touched, 5000u);
    CHECK_LE(handle.most_J, 0.0006 + 0.001);
    CHECK_EQ(handle.output.faults, 0u);
  }
}

TEST(Tool_AtTwoRates_TorqueIsThatOfTheModelInUse) {
  Handle bar(kBar);
  bar.go(kAbove_m, 100);
  bar.go(pressed(-0.01f, -0.017f), 100);
  bar.set(params::kModelAge, 12);
  for (uint32_t i = 0; i < 400; ++i) {
    // Now and then a model is taken a tick after it was made.
    bar.flags = i % 8 == 4 ? record::kFlagModelApart : bar.controller.model_flags();
    const float before_Nm = bar.output.torque_Nm[1];
    const float deep_m = i < 200 ? 0.00005f * static_cast<float>(i) - 0.008f : 0.002f;
    bar.tick(pressed(deep_m, -0.017f));
    if ((bar.flags & record::kFlagModelTaken) == 0) CHECK_EQ(bar.output.torque_Nm[1], before_Nm);
    if (i % 4 == 3) bar.controller.make_model();
  }
  CHECK_LE(std::fabs(wide(bar.output.force_N[2]) - 400 * 0.002), 0.005);
  CHECK_LE(std::fabs(wide(bar.output.torque_Nm[1]) + 0.01 * 400 * 0.002), 0.005 * 0.008);
  CHECK_EQ(bar.output.faults, 0u);
}

// Three of eight spheres find the box in a model, and each model lasts for 20 ticks: meanwhile it
// is uncertain. The motors come on with the first one that is certain.
TEST(Tool_EnabledAtTwoRatesWhileItFindsTheSurface_WaitsForAllSpheres) {
  Spheres eight;
  for (int i = 0; i < 8; ++i) eight.push_back({{0, 0, 0.004f * static_cast<float>(i)}, 0.001f});
  Placed<ToolController> tool(scene_with(eight));
  tool.input.command = 1 + params::kModelAge;
  tool.input.command_value = 50;
  uint32_t waited = 0;
  for (uint32_t i = 0; i < 800; ++i) {
    const float high_m = i < 200 ? 0.004f : 0.004f - 0.00001f * static_cast<float>(i - 200);
    tool.flags = tool.controller.model_flags();
    tool.tick({0, 0, kHalf_m + high_m});
    if (i % 20 == 2) tool.controller.make_model();
    CHECK_EQ(tool.output.faults, 0u);
    if (i < 10 || (tool.output.state & record::kStateUncertain) == 0) continue;
    ++waited;
    CHECK_EQ(tool.output.state & record::kStateServoMask, 0u);
  }
  CHECK_GE(waited, 30u);
  CHECK_LE(std::fabs(wide(tool.output.force_N[2]) - 100 * 0.003), 0.03);
}

TEST(Tool_AssetsThatDoNotFit_AreRejectedByName) {
  static ToolController controller;
  const auto rule = [](const std::vector<uint8_t>& bytes) {
    return controller.open(Asset(bytes).bytes()).rule;
  };
  CHECK_EQ(rule(scene_with(Spheres(9))), uint16_t{scene::kRuleSphereCount});
  CHECK_EQ(rule(scene_with({{{0, 0, 2}, 0.003f}})), uint16_t{scene::kRuleSpherePlace});
  std::vector<tools::Section> sections = box_sections("box");
  sections.push_back(tools::make_section(scene::kToolSection, "bar", kBar));
  for (tools::Section beside :
       {tools::make_section(scene::kObjectsSection, "room", std::vector<scene::ObjectLayout>(1)),
        tools::make_section(scene::kMaterialsSection, "box",
                            std::vector<scene::MaterialLayout>(1))}) {
    sections.push_back(std::move(beside));
    CHECK_EQ(rule(file_of(sections)), uint16_t{scene::kRuleToolAlone});
    sections.pop_back();
  }
  static FullController without;
  const Asset bar(scene_with(kBar));
  CHECK_EQ(without.open(bar.bytes()).rule, uint16_t{kRuleNeedsTool});
  CHECK_EQ(without.open(bar.bytes(), {"box", nullptr}).rule, uint16_t{kRuleNeedsTool});
  CHECK_EQ(faults_when_enabled(without), servo::kFaultAsset);
}

TEST(Tool_OfOneSphereAtTheHandle_HasTheForceOfTheSphere) {
  CHECK_LE(off_the_mesh_N<ToolController>(
               tools::make_section(scene::kToolSection, "tip", Spheres{{{0, 0, 0}, kRadius_m}})),
           0.001);
}
