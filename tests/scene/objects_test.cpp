// Several objects in closed form: what carries, pushes and squeezes a tool, and what is refused.
#include "firmtouch/scene/objects.hpp"

#include "firmtouch/math/elementary.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "firmtouch/servo/fault.hpp"
#include "firmtouch/servo/step.hpp"
#include "harness/test.hpp"
#include "scene/boxes_rig.hpp"
#include "servo/specials.hpp"

using namespace firmtouch;  // NOLINT: a test file
using math::Vec3;
using scene_boxes::Boxes;
using scene_boxes::is_near;
using scene_boxes::object_at;

TEST(Objects_EmptySetUnderLoadAndAnyRadius_LeavesTheToolAtTheHand) {
  const float radii_m[] = {0.003f, 0, -1, 1e9f, __builtin_inff(), __builtin_nanf("")};
  for (const float radius_m : radii_m) {
    Boxes boxes;
    boxes.add(object_at({0, 0, 0}));
    for (float z_m = 0.02f; z_m > 0.008f; z_m -= 0.001f) boxes.tick({0, 0, z_m});
    CHECK(boxes.output.force_N.z > 1.0f);
    boxes.contact.settings.radius_m = radius_m;
    for (uint32_t tick = 0; tick < 20; ++tick) {
      scene::begin_model(boxes.model, boxes.contact.position_m, boxes.now + tick, 2);
      scene::touch_objects(boxes.contact, {nullptr, nullptr, 0}, boxes, boxes.touch, boxes.model);
    }
    CHECK(is_near(boxes.touch.touch.proxy.position_m.z, boxes.contact.position_m.z, 0));
  }
}

// Below the other object is what the proxy's coordinates in the removed one's frame are in the
// device frame.
TEST(Objects_HolderThatIsRemoved_LeavesTheToolOnItsSide) {
  Boxes boxes;
  boxes.add(object_at({0, 0, 0.03f}));
  boxes.add(object_at({0, 0, 0.05f}));
  for (float z_m = 0.07f; z_m > 0.055f; z_m -= 0.001f) boxes.tick({0, 0, z_m});
  CHECK(is_near(boxes.output.proxy_m.z, 0.063f, 1e-5f));
  --boxes.count;
  for (uint32_t tick = 0; tick < 3; ++tick) {
    boxes.tick({0, 0, 0.055f});
    CHECK(is_near(boxes.output.proxy_m.z, 0.055f, 0));
  }
}

// A wall that rises by far more than a small tool's size in a tick.
TEST(Objects_WallThatRisesThroughAHeldTool_PushesItInEachTick) {
  const float radii_m[] = {Boxes::kRadius_m, 0.00002f}, speeds_mps[] = {0.05f, 0.5f, 5.0f};
  for (uint32_t run = 0; run < 6; ++run) {
    Boxes boxes;
    const float radius_m = boxes.contact.settings.radius_m = radii_m[run % 2];
    const float speed_mps = speeds_mps[run / 2];
    boxes.add(object_at({0, 0, -0.02f}, {0, 0, speed_mps}));
    for (float way_m = 0; way_m < 0.04f; way_m += speed_mps * Boxes::kTick_s) {
      boxes.tick({0.01f, 0.02f, 0.0f});
      const float top_m = boxes.object[0].pose.translation_m.z + 0.01f;
      const float wanted_N = 1000 * math::larger(top_m + radius_m, 0.0f);
      CHECK(is_near(boxes.output.force_N.z, wanted_N < 8 ? wanted_N : 8, 2e-3f));
      CHECK(is_near(boxes.output.force_N.x, 0.0f, 2e-3f));
      CHECK_EQ(boxes.output.faults, 0u);
    }
  }
}

// What a moving object does is not energy that the surface gives.
TEST(Objects_WallThatLiftsTheHand_IsNotCountedAsEnergyOfContact) {
  Boxes boxes;
  boxes.limits.energy.reservoir_J = 0.0015f;
  boxes.add(object_at({0, 0, -0.02f}, {0, 0, 0.2f}));
  float hand_m = -0.005f;
  for (int tick = 0; tick < 300; ++tick) {  // the hand keeps 3.2 mm behind: 3.2 N lift it by 40 mm
    const float top_m = boxes.object[0].pose.translation_m.z + 0.01f;
    if (hand_m < top_m) hand_m = top_m;
    boxes.tick({0, 0, hand_m});
    CHECK_EQ(boxes.output.faults, 0u);
  }
  CHECK(is_near(boxes.output.force_N.z, 3.2f, 0.01f));
}

// Its surface stays where it is. What the chord of the turn leads inward was taken for work, and
// emptied the reservoir: the force fell to 0.04 N.
TEST(Objects_BallThatTurns_PushesLikeOneThatStands) {
  const float turns_rad_per_s[] = {0.0f, 5.0f, 50.0f, 300.0f};
  for (const float turn_rad_per_s : turns_rad_per_s) {
    Boxes boxes;
    boxes.is_ball = true;
    boxes.limits.energy.reservoir_J = 0.0006f;
    boxes.add(object_at({}));
    boxes.object[0].twist.turn_rad_per_s = {0, turn_rad_per_s, 0};
    for (int tick = 0; tick < 2000; ++tick) {  // 1 mm deep
      const float left_m = tick < 300 ? 1e-5f * static_cast<float>(300 - tick) : 0.0f;
      boxes.tick({0, 0, 0.022f + left_m});
    }
    CHECK(is_near(boxes.output.force_N.z, 1.0f, 0.001f));
    CHECK(is_near(boxes.output.force_N.x, 0.0f, 0.001f));
    CHECK_EQ(boxes.output.faults, 0u);
  }
}

// A wall that slides under a hand that shakes: its speed was taken for the device's, whose friction
// fills the reservoir. The hand was given 50 mJ in 20 s.
TEST(Objects_WallThatSlides_GivesNoMoreThanOneThatStands) {
  constexpr float kFriction_N_per_m = 500;
  const float speeds_mps[] = {0.0f, 0.3f};
  float standing_J = 0;
  for (const float speed_mps : speeds_mps) {
    Boxes boxes;
    boxes.is_plane = true;
    boxes.contact.material.stiffness_N_per_m = 8000;
    boxes.limits.energy = {0.0006f, kFriction_N_per_m};
    boxes.add(object_at({0, 0, -0.01f}, {speed_mps, 0, 0}));
    float given_J = 0, before_m = 0, last_m = 0.004f;
    boxes.tick({0, 0, last_m});
    for (int tick = 0; tick < 4000; ++tick) {
      const float now_m = 0.0025f + 0.0003f * math::sine(0.8f * static_cast<float>(tick));
      const float move_m = now_m - last_m;
      given_J += boxes.output.force_N.z * move_m;
      if (move_m * before_m > 0) given_J -= kFriction_N_per_m * move_m * before_m;
      boxes.tick({0, 0, now_m});
      before_m = move_m;
      last_m = now_m;
    }
    if (speed_mps > 0) CHECK_LE(given_J, 1.01f * standing_J);
    standing_J = given_J;
  }
}

// A belt without friction leaves the tool where it is, one with friction takes it along until the
// pull of the hand is the friction.
TEST(Objects_Belt_DragsByItsFriction) {
  const float frictions[] = {0.0f, 0.5f};
  for (const float friction : frictions) {
    Boxes boxes;
    boxes.add(object_at({0, 0, -0.01f}));
    boxes.object[0].friction_static = boxes.object[0].friction_dynamic = friction;
    boxes.tick({0, 0, 0.005f});
    for (int tick = 0; tick < 10; ++tick) boxes.tick({0, 0, 0});  // 3 N
    boxes.object[0].twist.velocity_mps = {0.02f, 0, 0};
    boxes.tick({0, 0, 0});
    boxes.tick({0, 0, 0});
    CHECK(is_near(boxes.output.proxy_m.x, friction > 0 ? 4e-5f : 0.0f, 1e-6f));
    for (int tick = 0; tick < 300; ++tick) boxes.tick({0, 0, 0});
    CHECK(is_near(boxes.output.force_N.x, friction * 3.0f, 0.01f));
    CHECK(is_near(boxes.output.force_N.z, 3.0f, 0.01f));
    CHECK_EQ(boxes.output.faults, 0u);
  }
}

TEST(Objects_TurningTable_CarriesAStuckToolRound) {
  Boxes boxes;
  boxes.add(object_at({0, 0, -0.01f}));
  boxes.object[0].friction_static = boxes.object[0].friction_dynamic = 2.0f;
  Vec3 hand_m{0.05f, 0, 0.005f};
  boxes.tick(hand_m);
  hand_m.z = 0;
  boxes.tick(hand_m);
  boxes.tick(hand_m);
  boxes.object[0].twist.turn_rad_per_s = {0, 0, 1};
  for (int tick = 1; tick <= 1000; ++tick) {
    const float turned = 0.001f * static_cast<float>(tick);
    hand_m = {0.05f * math::cosine(turned), 0.05f * math::sine(turned), 0};
    boxes.tick(hand_m);
  }
  CHECK(is_near(boxes.output.proxy_m.x, 0.05f * math::cosine(1), 1e-5f));
  CHECK(is_near(boxes.output.proxy_m.y, 0.05f * math::sine(1), 1e-5f));
  CHECK(is_near(boxes.output.proxy_m.z, Boxes::kRadius_m, 2e-6f));
}

// Two walls that close at 0.5 m/s on a tool between them, with and without a hand that presses.
TEST(Objects_TwoClosingWalls_SqueezeAndLetGo) {
  const float hands_m[] = {0.0f, -0.004f};
  for (const float hand_z_m : hands_m) {
    Boxes boxes;
    boxes.add(object_at({0, 0, -0.03f}, {0, 0, 0.25f}));
    boxes.add(object_at({0, 0, 0.03f}, {0, 0, -0.25f}));
    uint32_t squeezed = 0, latched = 0;
    float gap_m = 0;
    for (uint32_t tick = 1; tick <= 100; ++tick) {
      boxes.tick({0, 0, hand_z_m});
      const float least_m =
          boxes.object[1].pose.translation_m.z - boxes.object[0].pose.translation_m.z - 0.02f;
      const Vec3 f = boxes.output.force_N;
      CHECK_LE(math::length(f), 8.0f);
      if (squeezed == 0 && boxes.touch.is_squeezed) squeezed = tick, gap_m = least_m;
      if (latched == 0 && boxes.output.faults != 0) latched = tick;
      if (squeezed != 0 && tick >= squeezed + 10) CHECK_EQ(math::length(f), 0.0f);
      if (boxes.touch.touch.proxy.phase == scene::Proxy::Phase::kFree && squeezed == 0) {
        CHECK_GE(boxes.output.proxy_m.z, boxes.object[0].pose.translation_m.z + 0.01f);
        CHECK_LE(boxes.output.proxy_m.z, boxes.object[1].pose.translation_m.z - 0.01f);
      }
    }
    CHECK_EQ(boxes.output.faults, servo::kFaultSqueezed);
    CHECK_EQ(latched, squeezed);
    CHECK_LE(gap_m, 2 * Boxes::kRadius_m);
    CHECK_GE(gap_m, 1.8f * Boxes::kRadius_m - 0.0005f);
  }
}

// A floor and a wall that comes from the side: the tool moves aside and keeps its size.
TEST(Objects_WallFromTheSide_PushesAToolAlongTheFloor) {
  Boxes boxes;
  boxes.is_plane = true;
  boxes.add(object_at({0, 0, -0.01f}));
  scene::Object wall = object_at({-0.03f, 0, 0}, {0.3f, 0, 0});
  wall.pose.rotation = {{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}};
  boxes.add(wall);
  boxes.tick({0, 0, 0.005f});
  for (int tick = 1; tick < 100; ++tick) {
    boxes.tick({0, 0, 0});
    const float face_m = boxes.object[1].pose.translation_m.x + 0.01f;
    CHECK(!boxes.touch.is_squeezed);
    CHECK(is_near(boxes.output.proxy_m.x, math::larger(face_m + Boxes::kRadius_m, 0.0f), 3e-6f));
    CHECK(is_near(boxes.output.proxy_m.z, Boxes::kRadius_m, 3e-6f));
  }
  CHECK_EQ(boxes.output.faults, 0u);
}

// A far object is not queried as long as its certificate lasts.
TEST(Objects_FarOnes_AreNotQueried) {
  Boxes boxes;
  for (uint32_t i = 0; i < scene::kMaxObjects; ++i) {
    const float far_m = 0.1f * static_cast<float>(i);
    boxes.add(object_at({0, 0, -0.01f - far_m}, {0, 0, i == 0 ? 0 : -0.001f}));
  }
  boxes.tick({0, 0, 0.01f});
  boxes.tick({0, 0, 0});
  const uint32_t begun = boxes.queries;
  for (uint32_t tick = 0; tick < 1000; ++tick)
    boxes.tick({0.00001f * static_cast<float>(tick % 100), 0, 0});
  CHECK_LE(begun, 3 * scene::kMaxObjects);
  CHECK_LE(boxes.queries, begun + 2100);  // of the one that is touched, about two a tick
  CHECK(is_near(boxes.output.force_N.z, 3.0f, 0.01f));
}

TEST(Objects_Material_IsThatOfTheObjectThatIsMet) {
  Boxes boxes;
  boxes.add(object_at({0, 0, -0.01f}));
  boxes.add(object_at({0, 0, 0.03f}));
  boxes.object[1].stiffness_N_per_m = 2000.0f / 3;  // 400 N/m in series with the tool's
  boxes.tick({0, 0, 0.005f});
  for (int tick = 0; tick < 5; ++tick) boxes.tick({0, 0, 0.001f});
  CHECK(is_near(boxes.output.force_N.z, 2.0f, 0.01f));
  boxes.tick({0, 0, 0.01f});
  for (int tick = 0; tick < 5; ++tick) boxes.tick({0, 0, 0.019f});
  CHECK(is_near(boxes.output.force_N.z, -0.8f, 0.01f));
}

// Inside of both at once, in the same place: led out as of one.
TEST(Objects_CoincidentAndNested_AreTouchedAsOne) {
  Boxes boxes;
  const float places_m[] = {-0.01f, -0.01f, -0.015f};
  for (const float place_m : places_m) boxes.add(object_at({0, 0, place_m}));
  for (int tick = 0; tick < 20; ++tick) boxes.tick({0, 0, -0.002f});
  CHECK_GE(boxes.output.force_N.z, 0.001f);
  CHECK_LE(boxes.output.force_N.z, 1.0f);
  boxes.tick({0, 0, 0.01f});
  for (int tick = 0; tick < 20; ++tick) boxes.tick({0, 0, 0});
  CHECK(is_near(boxes.output.force_N.z, 3.0f, 0.01f));
  CHECK_EQ(boxes.output.faults, 0u);
}

// A damper of 50 N s/m pushed by 8 N, the force limit.
TEST(Objects_HandThatGoesFartherIn_IsLedOutByAtMostOneNewton) {
  Boxes boxes;
  boxes.contact.material.damping_N_s_per_m = 50;
  boxes.is_plane = true;
  boxes.add(object_at({0, 0, -0.01f}));
  float most_N = 0;
  for (int tick = 0; tick < 2000; ++tick) {
    const float in_m = tick < 1500 ? 0.0f : 0.0005f * static_cast<float>(tick - 1500);
    boxes.tick({0, 0, -0.0001f - in_m}, {0, 0, tick < 1500 ? 0.0f : -0.5f});
    most_N = math::larger(most_N, boxes.output.force_N.z);
  }
  CHECK(is_near(most_N, 1.0f, 0.001f));
  CHECK_EQ(boxes.output.faults, 0u);
}

TEST(Objects_NoObject_IsAir) {
  Boxes boxes;
  for (int tick = 0; tick < 5; ++tick) boxes.tick({0, 0, 0.001f * static_cast<float>(tick)});
  CHECK_EQ(math::length(boxes.output.force_N), 0.0f);
  CHECK_EQ(boxes.output.faults, 0u);
}

TEST(Objects_PoseTwistOrMaterialOutOfRange_AreRefusedByName) {
  const auto refused = [](auto change) {
    scene::Object wanted = object_at({0, 0, 0.1f}), kept = object_at({0, 0, 0.2f}, {1, 0, 0});
    change(wanted);
    const scene::ObjectProblem problem = scene::set_object(wanted, kept);
    CHECK_EQ(kept.pose.translation_m.z, 0.2f);
    CHECK_EQ(kept.twist.velocity_mps.x, 0.0f);  // it stands still
    CHECK(scene::text_of(problem)[0] != 0);
    return problem;
  };
  using Problem = scene::ObjectProblem;
  CHECK(refused([](auto& o) { o.pose.rotation.row[1] = {0, 0, 0}; }) == Problem::kNotARotation);
  CHECK(refused([](auto& o) { o.pose.rotation.row[2].z = -1; }) == Problem::kNotARotation);
  CHECK(refused([](auto& o) { o.pose.rotation.row[0] = {1, 0.01f, 0}; }) == Problem::kNotARotation);
  CHECK(refused([](auto& o) { o.pose.translation_m.x = 1e6f; }) == Problem::kTooFarAway);
  CHECK(refused([](auto& o) { o.twist.velocity_mps.y = 1e6f; }) == Problem::kTooFast);
  CHECK(refused([](auto& o) { o.twist.turn_rad_per_s.y = -1e6f; }) == Problem::kTooFast);
  CHECK(refused([](auto& o) { o.stiffness_N_per_m = -1; }) == Problem::kMaterial);
  CHECK(refused([](auto& o) { o.friction_static = 1e9f; }) == Problem::kMaterial);
  const float nan = math::float_of(0x7FC00000u);
  CHECK(refused([&](auto& o) { o.pose.rotation.row[0].x = nan; }) == Problem::kNotARotation);
  CHECK(refused([&](auto& o) { o.pose.translation_m.z = nan; }) == Problem::kTooFarAway);
  CHECK(refused([&](auto& o) { o.twist.velocity_mps.z = nan; }) == Problem::kTooFast);
  CHECK(refused([&](auto& o) { o.friction_dynamic = nan; }) == Problem::kMaterial);
}

// Bits that no check has seen, in what the caller owns.
TEST(Objects_EverySpecialInPoseTwistAndPair_LeavesASoundModelAndALimitedForce) {
  for (uint32_t field = 0; field < 12; ++field) {
    for (const uint32_t bits : firmtouch::test::kSpecialBits) {
      Boxes boxes;
      boxes.add(object_at({0, 0, -0.01f}, {0, 0, 0.01f}));
      boxes.add(object_at({0, 0, 0.1f}));
      boxes.tick({0, 0, 0.005f});
      for (int tick = 0; tick < 5; ++tick) boxes.tick({0, 0, 0});
      const float value = math::float_of(bits);
      scene::Object& object = boxes.object[field % 2];
      scene::ObjectPair& pair = boxes.pair[field % 2];
      float* const places[] = {&object.pose.rotation.row[1].y, &object.pose.translation_m.z,
                               &object.twist.velocity_mps.z,   &object.twist.turn_rad_per_s.x,
                               &pair.pose.translation_m.y,     &pair.lower_m};
      *places[field / 2] = value;
      for (int tick = 0; tick < 30; ++tick) {
        boxes.tick({0, 0, 0});
        CHECK(servo::is_sound(boxes.model));
        CHECK_LE(math::length(boxes.output.force_N), 8.0f);
      }
    }
  }
}
