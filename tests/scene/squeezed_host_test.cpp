// Objects that move leave a tool between them its room, but the balls that are certified do not say
// so: it is not squeezed.
#include "scene/boxes_rig.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace scene_boxes;

// It presses on a floor and the ceiling slides by: a tick moves it farther than its gap is wide.
TEST(Squeezed_CeilingThatSlidesByAToolWithFriction_LeavesItsRoom) {
  const float frictions[] = {0.0f, 0.3f, 2.0f}, gaps_m[] = {1e-5f, 1e-4f, 1e-3f};
  for (const float friction : frictions) {
    for (const float gap_m : gaps_m) {
      Boxes boxes;
      boxes.is_plane = true;
      boxes.contact.settings.friction_static = friction;
      boxes.contact.settings.friction_dynamic = friction;
      boxes.add(object_at({0, 0, -0.01f}));
      scene::Object ceiling = object_at({0, 0, 2 * Boxes::kRadius_m + gap_m + 0.01f});
      ceiling.pose.rotation = {{{1, 0, 0}, {0, -1, 0}, {0, 0, -1}}};
      boxes.add(ceiling);
      boxes.tick({0, 0, Boxes::kRadius_m + 0.5f * gap_m});
      for (int tick = 0; tick < 5; ++tick) boxes.tick({0.001f, 0, 0});
      boxes.object[1].twist.velocity_mps = {0.7f, 0, 0};
      for (int tick = 0; tick < 200; ++tick) boxes.tick({0.001f, 0, 0});
      CHECK_EQ(boxes.output.faults, 0u);
      CHECK(is_near(boxes.output.proxy_m.z, Boxes::kRadius_m, 3e-6f));
    }
  }
}

// It presses into the corner of three walls, each of which slides in its own plane.
TEST(Squeezed_CornerOfWallsThatSlideInTheirPlanes_LeavesItsRoom) {
  const scene::Object at_rest[3] = {
      {{{{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}}, {-0.01f, 0, 0}}, {}},
      {{{{{1, 0, 0}, {0, 0, 1}, {0, -1, 0}}}, {0, -0.01f, 0}}, {}},
      object_at({0, 0, -0.01f}),
  };
  const float speeds_mps[] = {0.05f, 0.4f};
  for (uint32_t turn = 0; turn < 128; ++turn) {
    Boxes boxes;
    boxes.is_plane = true;
    for (const scene::Object& wall : at_rest) boxes.add(wall);
    boxes.tick({0.004f, 0.004f, 0.004f});
    for (int tick = 0; tick < 20; ++tick) boxes.tick({0.002f, 0.002f, 0.002f});
    const float speed_mps = speeds_mps[turn / 64];
    const float along_mps[] = {speed_mps, 0, -speed_mps, 0};
    const auto first_mps = [&](uint32_t i) { return along_mps[turn >> 2 * i & 3]; };
    const auto second_mps = [&](uint32_t i) { return along_mps[((turn >> 2 * i) + 1) & 3]; };
    boxes.object[0].twist.velocity_mps = {0, first_mps(0), second_mps(0)};
    boxes.object[1].twist.velocity_mps = {first_mps(1), 0, second_mps(1)};
    boxes.object[2].twist.velocity_mps = {first_mps(2), second_mps(2), 0};
    for (int tick = 0; tick < 50; ++tick) {
      boxes.tick({0.002f, 0.002f, 0.002f});
      const float aways_m[] = {boxes.output.proxy_m.x, boxes.output.proxy_m.y,
                               boxes.output.proxy_m.z};
      for (const float away_m : aways_m) CHECK(is_near(away_m, Boxes::kRadius_m, 3e-6f));
    }
    CHECK_EQ(boxes.output.faults, 0u);
  }
}

// It began too near to a floor and grows to its size. A wall that slides by pushes it meanwhile.
TEST(Squeezed_ToolThatIsPushedWhileItGrows_GoesOnGrowing) {
  Boxes boxes;
  boxes.is_plane = true;
  boxes.add(object_at({0, 0, -0.01f}));
  boxes.add({{{{{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}}}, {-0.014f, 0, 0}}, {}});
  for (int tick = 0; tick < 300; ++tick) {
    boxes.object[1].twist.velocity_mps = {0, tick >= 20 && tick < 24 ? 3.0f : 0.0f, 0};
    boxes.tick({0, 0, 0.002f});
  }
  CHECK_EQ(boxes.output.faults, 0u);
  CHECK(is_near(boxes.output.proxy_m.z, Boxes::kRadius_m, 3e-6f));
  CHECK(is_near(boxes.output.force_N.z, 1.0f, 0.003f));
}
