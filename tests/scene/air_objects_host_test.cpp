// Objects without stiffness: what is in them is touched as if they were not there.
#include <float.h>

#include "scene/boxes_rig.hpp"

using namespace firmtouch;  // NOLINT: a test file
using math::Vec3;
using scene_boxes::Boxes;
using scene_boxes::is_near;
using scene_boxes::object_at;

// The tool was led out of the air, without force, and so through what is in it.
TEST(Objects_SolidInAir_IsTouchedAsAlone) {
  Boxes alone, both;
  alone.add(object_at({0, 0, -0.01f}));
  both.add(object_at({0, 0, -0.01f}));
  both.add(object_at({0, 0, 0.005f}, {0, 0, 0.01f})).stiffness_N_per_m = 0;
  for (int tick = 0; tick < 100; ++tick) {
    const Vec3 hand_m{0, 0, 0.03f - 0.0004f * static_cast<float>(tick)};
    alone.tick(hand_m);
    both.tick(hand_m);
    CHECK_EQ(alone.output.force_N.z, both.output.force_N.z);
  }
  CHECK_GE(both.output.force_N.z, 7.99f);
  CHECK_EQ(both.output.faults, 0u);
}

// From the surface of a solid that turns to air the hand goes on in: with a force that falls.
TEST(Objects_SolidThatTurnsToAir_LetsGoAndIsThereAgain) {
  Boxes boxes;
  boxes.add(object_at({0, 0, -0.01f}));
  boxes.tick({0, 0, 0.01f});
  for (int tick = 0; tick < 5; ++tick) boxes.tick({0, 0, 0});
  boxes.object[0].stiffness_N_per_m = 0;
  float was_N = boxes.output.force_N.z;
  CHECK(is_near(was_N, 3.0f, 0.01f));
  for (int tick = 0; tick < 200; ++tick) {
    boxes.tick({0, 0, 0});
    CHECK(is_near(boxes.output.force_N.z, was_N, 0.021f));
    was_N = boxes.output.force_N.z;
  }
  CHECK_EQ(was_N, 0.0f);
  const uint32_t queries = boxes.queries;
  for (int tick = 0; tick < 20; ++tick) boxes.tick({0, 0, 0.001f * static_cast<float>(tick)});
  CHECK_EQ(boxes.queries, queries);
  boxes.object[0].stiffness_N_per_m = FLT_MAX;
  for (int tick = 0; tick < 20; ++tick) boxes.tick({0, 0, 0});
  CHECK(is_near(boxes.output.force_N.z, 3.0f, 0.01f));
  CHECK_EQ(boxes.output.faults, 0u);
}
