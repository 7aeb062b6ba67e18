// The parts of a model's force: each alone, and together all of it.
#include "firmtouch/servo/force_parts.hpp"

#include <float.h>

#include "firmtouch/servo/evaluate.hpp"
#include "firmtouch/servo/proxy_spring.hpp"
#include "harness/test.hpp"

namespace math = firmtouch::math;
namespace servo = firmtouch::servo;

TEST(PartsOfTheForce_AreThoseOfPlanesSpringAndGuide) {
  servo::LocalModel model;
  model.plane[0].normal = {0, 0, 1};
  model.plane[0].stiffness_N_per_m = 1000.0f;
  model.plane[1].normal = {0, 1, 0};
  model.plane[1].stiffness_N_per_m = 500.0f;
  model.plane_count = 2;
  model.guide.direction = {1, 0, 0};
  model.guide.stiffness_N_per_m = 250.0f;
  model.has_guide = true;
  const math::Vec3 hand_m{0.125f, -0.5f, -0.25f};
  // 1,000 N/m of 0.25 m, 500 N/m of 0.5 m; back to the line.
  const math::Vec3 contact_N = servo::contact_N(model, hand_m, {});
  CHECK_EQ(contact_N.x, 0.0f);
  CHECK_EQ(contact_N.y, 250.0f);
  CHECK_EQ(contact_N.z, 250.0f);
  const math::Vec3 guide_N = servo::guide_N(model, hand_m, {});
  CHECK_EQ(guide_N.x, 0.0f);
  CHECK_EQ(guide_N.y, 125.0f);
  CHECK_EQ(guide_N.z, 62.5f);
  const math::Vec3 all_N = servo::evaluate(model, hand_m, {});
  CHECK_EQ(contact_N.y + guide_N.y, all_N.y);
  CHECK_EQ(contact_N.z + guide_N.z, all_N.z);

  // A proxy that an object carries: its damper feels how fast the hand comes nearer to it.
  servo::LocalModel carried;
  carried.spring.is_used = true;
  carried.spring.stiffness_N_per_m = 1000.0f;
  carried.spring.damping_N_s_per_m = 2.0f;
  carried.spring.velocity_mps = {0, 0, 3};
  CHECK_EQ(servo::contact_N(carried, {0, 0, -0.25f}, {0, 0, 1}).z, 254.0f);
  CHECK_EQ(servo::guide_N(carried, hand_m, {}).z, 0.0f);
}
