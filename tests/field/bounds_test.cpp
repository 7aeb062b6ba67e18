#include "firmtouch/field/distance_bounds.hpp"

#include <float.h>

#include "cube_field.hpp"
#include "firmtouch/core/hash.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using field_test::coordinate;
using field_test::CubeField;
using field_test::Opened;
using math::Vec3;

// Signed distance to the cube from -1 to 1, negative inside.
float truth_of(Vec3 p) {
  const float x = (p.x < 0 ? -p.x : p.x) - 1, y = (p.y < 0 ? -p.y : p.y) - 1,
              z = (p.z < 0 ? -p.z : p.z) - 1;
  const float most = x > y ? (x > z ? x : z) : (y > z ? y : z);
  if (most <= 0) return most;
  const auto plus = [](float v) { return v > 0 ? v : 0.0f; };
  return math::length(Vec3{plus(x), plus(y), plus(z)});
}

}  // namespace

TEST(Bounds_ContainTheCubesDistanceAndSign_InAndOutsideTheGrid) {
  const Opened o;
  uint32_t state = 1, known = 0;
  const float reaches[] = {1.0f, 1.4f, 3.0f, 100.0f};
  for (const float reach : reaches) {
    for (uint32_t i = 0; i < 2000; ++i) {
      const Vec3 p{coordinate(state, reach), coordinate(state, reach), coordinate(state, reach)};
      const field::Bounds b = field::distance_bounds(o.view, p);
      const float signed_m = truth_of(p), truth_m = signed_m < 0 ? -signed_m : signed_m;
      CHECK_LE(b.lower_m, truth_m * (1 + 0x1p-20f) + 1e-6f);
      CHECK_GE(b.upper_m, truth_m * (1 - 0x1p-20f) - 1e-6f);
      if (b.lower_m > 0) CHECK_EQ(static_cast<int>(b.sign), signed_m < 0 ? -1 : 1);
      known += b.lower_m > 0 ? 1u : 0u;
    }
  }
  CHECK_GT(known, 5000u);
}

TEST(Bounds_AtACellCentre_AreTwoQuantaApart) {
  const Opened o;
  for (uint32_t i = 0; i < CubeField::kCells; ++i) {
    const field::Bounds b = field::distance_bounds(o.view, o.distance_field.centre_of(i));
    CHECK_LE(b.upper_m - b.lower_m, 2.0f * o.distance_field.head.quantum_m + 2e-6f);
    CHECK_EQ(b.seed, o.distance_field.seeds[i]);
  }
}

TEST(HostilePointsGiveFiniteBoundsThatAreTrue) {
  const Opened o;
  const float nan = __builtin_nanf(""), infinite = __builtin_inff();
  const float bads[] = {nan, infinite, -infinite};
  for (const float bad : bads) {
    for (uint32_t k = 0; k < 3; ++k) {
      Vec3 p{0, 0, 0};
      (&p.x)[k] = bad;
      const field::Bounds b = field::distance_bounds(o.view, p);
      CHECK(b.lower_m >= 0 && b.lower_m <= 0 && b.upper_m <= FLT_MAX && b.sign == 0);
    }
  }
  const float fars[] = {1e10f, 1e18f, 1e19f, 2e19f, 1e30f, FLT_MAX};
  for (const float far : fars) {
    const field::Bounds b = field::distance_bounds(o.view, {far, -far, 0});
    CHECK(b.lower_m >= 0 && b.lower_m / 1.5f <= far && b.upper_m <= FLT_MAX && b.upper_m >= far);
    CHECK_EQ(static_cast<int>(b.sign), 1);
  }
  const field::Bounds tiny = field::distance_bounds(o.view, {1e-42f, -1e-42f, 0});
  CHECK(tiny.lower_m > 0.5f && tiny.sign == -1);
}

TEST(UnknownCell_IsBoundedByTheGridsBox) {
  CubeField distance_field;
  for (int16_t& word : distance_field.words) word = field::kUnknown;
  field::View view;
  const mesh::View mesh = distance_field.cube.view();
  CHECK(field::open(distance_field.sections(), mesh, view).ok());
  const field::Bounds in = field::distance_bounds(view, {0, 0, 0});
  CHECK(in.lower_m <= 0 && in.upper_m >= FLT_MAX && in.sign == 0);
  const field::Bounds out = field::distance_bounds(view, {4, 0, 0});
  CHECK(out.lower_m > 2.6f && out.lower_m < 3 && out.sign == 1);
}

TEST(BoundsHaveOneHashEverywhere) {
  const Opened o;
  uint32_t state = 9;
  core::Hash hash;
  for (uint32_t i = 0; i < 500; ++i) {
    const float reach = i % 5 == 0 ? 1e3f : 1.5f;
    const math::Vec3 p_m{coordinate(state, reach), coordinate(state, reach),
                         coordinate(state, reach)};
    const field::Bounds bounds = field::distance_bounds(o.view, p_m);
    hash.add(math::bits_of(bounds.lower_m));
    hash.add(math::bits_of(bounds.upper_m));
    hash.add(static_cast<uint32_t>(bounds.sign + 1));
    hash.add(bounds.seed);
  }
  CHECK_EQ(hash.value(), 0xba436f9956624b7cu);
}
