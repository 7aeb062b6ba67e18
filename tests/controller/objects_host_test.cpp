// Several objects of an asset in a ready controller: each is touched where its pose puts it, by its
// own material; a command moves it; who cannot touch it rejects it by name.
#include "controller/placed.hpp"
#include "firmtouch/controller/objects_controller.hpp"
#include "firmtouch/math/vec3_ops.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace controller_test;

namespace {

constexpr float kRadius_m = 0.003f;

struct Touching : Placed<ObjectsController> {
  explicit Touching(const std::vector<Named>& named) : Placed(scene_with(named)) { begin(); }

  bool move(uint32_t object, float speed, math::Vec3 at_m, uint32_t at_tick = 0) {
    input.flags = at_tick;
    return takes(record::kCommandMoveObject + object, speed, at_m);
  }
  void press(math::Vec3 above_m, float deep_m) {
    const math::Vec3 top_m = above_m + math::Vec3{0, 0, kHalf_m + kRadius_m};
    go(top_m + math::Vec3{0, 0, 0.01f}, 300);
    go(top_m - math::Vec3{0, 0, deep_m}, 300);
    stay(300);
  }
  uint32_t object() const { return output.state >> record::kStateObjectShift & 31u; }
};

}  // namespace

TEST(Objects_EachIsTouchedAtItsPlace_ByItsStiffness) {
  Touching scene({{"left", "box", {-0.06f, 0, 0}, 800}, {"right", "box", {0.06f, 0, 0.01f}}});
  scene.press({-0.06f, 0, 0}, 0.002f);
  CHECK_EQ(scene.object(), 1u);
  CHECK_LE(std::fabs(wide(scene.output.force_N[2]) - 400 * 0.002),
           0.004);  // two springs in series
  scene.go({-0.06f, 0, 0.05f}, 300);
  CHECK_EQ(scene.object(), 0u);
  scene.press({0.06f, 0, 0.01f}, 0.002f);
  CHECK_EQ(scene.object(), 2u);
  CHECK_LE(std::fabs(wide(scene.output.force_N[2]) - 800 * 0.002), 0.008);
  CHECK_EQ(scene.output.faults, 0u);
}

TEST(Objects_StandUntilACommandMovesThem_AndReturn) {
  Touching scene({{"box", "box", {}, 1e30f, {0, 0, 0.05f}}});
  scene.press({}, 0.001f);
  const float before_N = scene.output.force_N[2];
  const math::Vec3 hand_m{0, 0, kHalf_m + kRadius_m - 0.001f};
  for (uint32_t i = 0; i < 100; ++i) scene.tick(hand_m);
  CHECK_LE(std::fabs(wide(scene.output.force_N[2]) - wide(before_N)), 1e-4);
  // Up by 50 mm/s x 0.5 in 100 ticks: 2.5 mm more of an 800 N/m spring, and back.
  CHECK(scene.move(0, 0.5f, hand_m));
  for (uint32_t i = 1; i < 100; ++i) scene.tick(hand_m);
  CHECK_LE(std::fabs(wide(scene.output.force_N[2]) - wide(before_N) - 800 * 0.0025), 0.01);
  CHECK(scene.move(0, -0.5f, hand_m));
  for (uint32_t i = 1; i < 100; ++i) scene.tick(hand_m);
  CHECK(scene.move(0, 0, hand_m));
  for (uint32_t i = 0; i < 50; ++i) scene.tick(hand_m);
  CHECK_LE(std::fabs(wide(scene.output.force_N[2]) - wide(before_N)), 0.005);
  CHECK_EQ(scene.output.faults, 0u);
}

TEST(Objects_MoveCommand_IsRefusedForAnUnknownObjectAndAnySpeedOutOfRange) {
  Touching scene({{"a", "box", {}}, {"b", "box", {0.1f, 0, 0}}});
  const math::Vec3 hand_m{0, 0, 0.1f};
  CHECK(scene.move(1, -1, hand_m));
  for (const uint32_t object : {2u, 15u, 100u, 0xF0u}) CHECK(!scene.move(object, 0, hand_m));
  for (const float speed : {1.001f, -1.001f, std::numeric_limits<float>::quiet_NaN(),
                            std::numeric_limits<float>::infinity()})
    CHECK(!scene.move(0, speed, hand_m));
  CHECK(!scene.move(0, 1, hand_m, record::kFlagModelApart));  // at two rates objects stand
}

TEST(Objects_OneThatStoppedAt10m_ReturnsByACommand) {
  Touching scene({{"far", "box", {0, 0, 9.99f}, 1e30f, {0, 0, 1}}});
  const math::Vec3 hand_m{0, 0, 0.1f};
  const auto at_m = [&] { return scene.controller.objects().object(0).pose.translation_m.z; };
  CHECK(scene.move(0, 1, hand_m));
  scene.stay(100);
  CHECK_GE(at_m(), 9.998f);
  CHECK_LE(at_m(), 10.0f);
  CHECK(scene.move(0, -1, hand_m));
  scene.stay(99);
  CHECK_LE(std::fabs(wide(at_m()) - 9.9), 0.002);
}

TEST(Objects_Friction_IsTheLargerOfObjectAndParameter) {
  Touching rough({{"box", "box", {}, 1e30f, {}, 0.5f}});
  rough.set(params::kFrictionStatic, 0.2f);
  rough.set(params::kFrictionDynamic, 0.2f);
  const auto check_slide = [](Touching& scene, double friction) {
    scene.press({-0.01f, 0, 0}, 0.002f);
    const auto ratio = [&] {
      return -wide(scene.output.force_N[0]) / wide(scene.output.force_N[2]);
    };
    const float z_m = kHalf_m + kRadius_m - 0.002f;
    scene.go({0.01f, 0, z_m}, 400);
    CHECK_LE(std::fabs(ratio() - friction), 0.01);
    for (uint32_t i = 0; i < 300; ++i) scene.tick(scene.place_m);
    CHECK_LE(std::fabs(ratio() - friction), 0.01);  // at rest
  };
  check_slide(rough, 0.5);
  Touching smooth(std::vector<Named>{{"box", "box", {}}});
  smooth.set(params::kFrictionStatic, 0.2f);
  smooth.set(params::kFrictionDynamic, 0.2f);
  check_slide(smooth, 0.2);
}

TEST(Objects_OneThatStandsAtTheOrigin_HasTheForceOfTheMeshAlone) {
  const std::vector<scene::ObjectLayout> one = {layout_of({"part", "part", {}})};
  CHECK_LE(
      off_the_mesh_N<ObjectsController>(tools::make_section(scene::kObjectsSection, "room", one)),
      0.01);
}

TEST(Objects_SceneOrigin_MovesThemAll) {
  Touching scene(std::vector<Named>{{"box", "box", {0.01f, 0, 0}}});
  scene.controller.reset();
  scene.tick_number = 0;
  scene.set(params::kSceneX, 0.05f);
  scene.press({0.06f, 0, 0}, 0.002f);
  CHECK_EQ(scene.object(), 1u);
  CHECK_LE(std::fabs(wide(scene.output.force_N[2]) - 800 * 0.002), 0.05);
}

TEST(Objects_AssetsThatDoNotFit_AreRejectedByName) {
  static ObjectsController controller;
  const auto rule = [](const std::vector<uint8_t>& bytes) {
    return controller.open(Asset(bytes).bytes()).rule;
  };
  CHECK_EQ(rule(scene_with({{"a", "bax", {}}})), uint16_t{scene::kRuleObjectMesh});
  CHECK_EQ(rule(scene_with({{"a", "box", {11, 0, 0}}})), uint16_t{scene::kRuleObjectTooFar});
  std::vector<std::string> meshes;
  std::vector<Named> objects;
  static const char* const kNames[] = {"1", "2", "3", "4", "5", "6", "7", "8", "9"};
  for (const char* name : kNames) meshes.push_back(name), objects.push_back({name, name, {}});
  CHECK_EQ(rule(scene_with(objects, meshes)), uint16_t{scene::kRuleObjectMeshes});
  meshes.pop_back(), objects.pop_back();
  CHECK_EQ(rule(scene_with(objects, meshes)), 0u);
  static FullController without;
  const Asset room(scene_with({{"a", "box", {}}}));
  CHECK_EQ(without.open(room.bytes()).rule, uint16_t{kRuleNeedsObjects});
  CHECK_EQ(faults_when_enabled(without), servo::kFaultAsset);
  CHECK_EQ(without.open(room.bytes(), {"box", nullptr}).rule, 0u);  // the mesh alone, by its name
}

TEST(Objects_Reset_PutsThemBack) {
  Touching scene({{"box", "box", {}, 1e30f, {0.1f, 0, 0}}});
  const math::Vec3 hand_m{0, 0, 0.1f};
  scene.tick(hand_m);
  CHECK(scene.move(0, 1, hand_m));
  for (uint32_t i = 0; i < 100; ++i) scene.tick(hand_m);
  CHECK(scene.controller.objects().object(0).pose.translation_m.x > 0.0099f);
  scene.controller.reset();
  scene.tick(hand_m);
  CHECK_EQ(scene.controller.objects().object(0).pose.translation_m.x, 0.0f);
  for (uint32_t i = 0; i < 100; ++i) scene.tick(hand_m);
  CHECK_EQ(scene.controller.objects().object(0).pose.translation_m.x, 0.0f);
}
