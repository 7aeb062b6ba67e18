// What effects do to a local model: planes, guides, the certified free radius, and shapes of a
// user's own.
#include "firmtouch/scene/compose.hpp"

#include <float.h>
#include <stdint.h>

#include "firmtouch/math/isa.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "harness/test.hpp"

namespace math = firmtouch::math;
namespace scene = firmtouch::scene;
namespace servo = firmtouch::servo;

namespace {

const scene::Material kMaterial{1000.0f, 2.0f};

servo::LocalModel fresh(math::Vec3 position_m) {
  servo::LocalModel model;
  scene::begin_model(model, position_m, 7, 3);
  return model;
}

scene::SurfacePoint surface(float distance_m, math::Vec3 normal, int8_t sign) {
  return {distance_m, normal, sign};
}

bool is_near(float a, float b) { return a - b < 1e-6f && b - a < 1e-6f; }

}  // namespace

TEST(ModelBeginsEmptyOneNumberOnAndWithItsExpiry) {
  servo::LocalModel model;
  model.sequence = 41;
  model.plane_count = 2;
  model.has_guide = true;
  scene::begin_model(model, {1, 2, 3}, 0xFFFFFFFEu, 3);
  CHECK_EQ(model.sequence, 42u);
  CHECK_EQ(model.plane_count, 0u);
  CHECK(!model.has_guide);
  CHECK_EQ(model.made_tick, 0xFFFFFFFEu);
  CHECK_EQ(model.expires_tick, 1u);
  CHECK_EQ(model.made_at_m.z, 3.0f);
  CHECK(servo::is_sound(model));
}

TEST(ContactPushesBackByTheDepthOfTheSphere) {
  servo::LocalModel model = fresh({0, 0, 0.004f});
  const float depth_m =
      scene::add_contact(model, {0, 0, 0.004f}, 0.005f, surface(0.004f, {0, 0, 1}, 1), kMaterial);
  CHECK(is_near(depth_m, 0.001f));
  CHECK(is_near(servo::evaluate(model, {0, 0, 0.004f}, {}).z, 1.0f));
  CHECK(is_near(servo::evaluate(model, {0, 0, 0.003f}, {}).z, 2.0f));  // at a fresher position
  CHECK_EQ(servo::evaluate(model, {0, 0, 0.0051f}, {}).z, 0.0f);
}

TEST(ContactInsideReachesRadiusAndDepthDeep) {
  servo::LocalModel model = fresh({});
  CHECK(is_near(scene::add_contact(model, {}, 0.005f, surface(-0.002f, {0, 1, 0}, -1), kMaterial),
                0.007f));
  CHECK(is_near(servo::evaluate(model, {}, {}).y, 7.0f));
}

TEST(UnknownSideIsNeverPushedOn) {
  servo::LocalModel model = fresh({});
  CHECK_EQ(scene::add_contact(model, {}, 0.005f, surface(0.0f, {0, 0, 1}, 0), kMaterial), 0.0f);
  CHECK_EQ(model.plane_count, 0u);
}

TEST(NormalsThatAreNoneMakeNoPlane) {
  const float nan = math::float_of(0x7FC00000u), inf = math::float_of(0x7F800000u);
  const math::Vec3 normals[] = {{0, 0, 0}, {nan, 0, 1},     {inf, 0, 0},
                                {0, 0, 2}, {FLT_MAX, 0, 0}, {1e-30f, 0, 0}};
  for (const math::Vec3 normal : normals) {
    servo::LocalModel model = fresh({});
    CHECK_EQ(scene::add_contact(model, {}, 0.005f, surface(0.001f, normal, 1), kMaterial), 0.0f);
    CHECK_EQ(model.plane_count, 0u);
  }
  const float distances[] = {nan, inf, -inf};
  for (const float distance : distances) {
    servo::LocalModel model = fresh({});
    CHECK_EQ(scene::add_contact(model, {}, 0.005f, {distance, {0, 0, 1}, 1}, kMaterial), 0.0f);
    CHECK_EQ(model.plane_count, 0u);
    CHECK(servo::is_sound(model));
  }
}

TEST(OfManyContactsTheDeepestAreKept) {
  servo::LocalModel model = fresh({});
  const float distance_m[] = {0.004f, 0.001f, 0.003f, 0.002f, 0.0045f, -0.001f};
  for (const float d : distance_m) {
    (void)scene::add_contact(model, {}, 0.005f,
                             surface(d, {0, 0, 1}, d < 0 ? int8_t{-1} : int8_t{1}), kMaterial);
  }
  CHECK_EQ(model.plane_count, servo::kMaxPlanes);
  // 4 mm, 6 mm and 3 mm deep, a newton a millimetre.
  CHECK(is_near(servo::evaluate(model, {}, {}).z, 13.0f));
}

TEST(SecondGuideAndFourthPlaneAreRefused) {
  servo::LocalModel model = fresh({});
  servo::GuideLine line;
  line.direction = {1, 0, 0};
  CHECK(scene::add_guide(model, line));
  line.direction = {0, 1, 0};
  CHECK(!scene::add_guide(model, line));
  CHECK_EQ(model.guide.direction.x, 1.0f);
  servo::ContactPlane plane;
  plane.normal = {0, 0, 1};
  for (uint32_t i = 0; i < servo::kMaxPlanes; ++i) CHECK(scene::add_plane(model, plane));
  CHECK(!scene::add_plane(model, plane));
}

TEST(UsersOwnShapeComposesWithTheRest) {
  // A ball of 20 mm about the origin, touched from inside: what a user writes is a distance, a
  // normal and a side.
  const auto bowl = [](math::Vec3 p_m, servo::LocalModel& model) {
    const float out_m = math::square_root(p_m.x * p_m.x + p_m.y * p_m.y + p_m.z * p_m.z);
    if (!(out_m > 1e-6f)) return;
    const math::Vec3 inward{-p_m.x / out_m, -p_m.y / out_m, -p_m.z / out_m};
    (void)scene::add_contact(model, p_m, 0.002f, {0.02f - out_m, inward, 1}, kMaterial);
  };
  const math::Vec3 p_m{0, 0.019f, 0};
  servo::LocalModel model = fresh(p_m);
  bowl(p_m, model);
  (void)scene::add_contact(model, p_m, 0.002f, surface(0.001f, {0, 0, 1}, 1),
                           kMaterial);  // and a floor
  const math::Vec3 force_N = servo::evaluate(model, p_m, {});
  CHECK(is_near(force_N.y, -1.0f));
  CHECK(is_near(force_N.z, 1.0f));
}
