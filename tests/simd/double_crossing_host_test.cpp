// What doubles decide of a segment and a triangle has the bits of the integers, and they decide
// nearly everything that touches nothing.
#include "simd/search/double_crossing.hpp"

#include "firmtouch/math/vec3_ops.hpp"
#include "harness/random.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using math::Vec3;

test::Xorshift next_random(11);

float between(float low, float high) {
  return low + (high - low) * (static_cast<float>(next_random() >> 8) * 0x1p-24f);
}

struct Case {
  Vec3 a, b, corner[3];
};

// A segment about a triangle that it usually crosses, anywhere, of any size.
Case crossing_case() {
  const float size = math::float_of((87u + next_random() % 80u) << 23);
  const auto any = [size](float z) {
    return Vec3{size * between(-1, 1), size * between(-1, 1), size * z};
  };
  Case c;
  for (Vec3& corner : c.corner) corner = any(between(-0.1f, 0.1f)) * 3.0f;
  c.a = any(between(0.2f, 1)), c.b = any(between(-1, -0.2f));
  return c;
}

// On a lattice: much touches, or lies in one plane.
Case lattice_case() {
  const auto any = [] {
    const auto whole = [] { return static_cast<float>(next_random() % 4u); };
    return Vec3{whole(), whole(), whole()};
  };
  return {any(), any(), {any(), any(), any()}};
}

// A corner in the middle of the segment: the line passes two edges in it, and roundings alone say
// on which side.
Case middle_case() {
  Case c = crossing_case();
  const Vec3 half{between(-1, 1), between(-1, 1), between(-1, 1)};
  c.a = half * 2.0f, c.b = {0, 0, 0};
  c.corner[next_random() % 3u] = half;
  return c;
}

struct Count {
  uint32_t decided = 0, crossed = 0, wrong = 0;
};

Count compare(Case (*make)(), uint32_t cases) {
  Count count;
  for (uint32_t i = 0; i < cases; ++i) {
    const Case c = make();
    mesh::Crossing by_doubles;
    if (!simd::decides_in_double(c.a, c.b, c.corner[0], c.corner[1], c.corner[2], by_doubles))
      continue;
    ++count.decided;
    const mesh::Crossing exact =
        mesh::exact_crossing(c.a, c.b, c.corner[0], c.corner[1], c.corner[2]);
    count.crossed += exact.direction != 0 ? 1 : 0;
    if (by_doubles.direction != exact.direction ||
        math::bits_of(by_doubles.t) != math::bits_of(exact.t))
      ++count.wrong;
  }
  return count;
}

}  // namespace

TEST(Doubles_DecideNearlyAllCrossings_AsTheIntegers) {
  const Count count = compare(crossing_case, 20000);
  CHECK_EQ(count.wrong, 0u);
  CHECK(count.decided > 19900);
  CHECK(count.crossed > 1000);
}

TEST(Doubles_LeaveWhatTouchesToTheIntegers) {
  const Count lattice = compare(lattice_case, 20000);
  CHECK_EQ(lattice.wrong, 0u);
  CHECK(lattice.decided > 2000 && lattice.decided < 18000);
  const Count middle = compare(middle_case, 20000);
  CHECK_EQ(middle.wrong, 0u);
  CHECK(middle.decided < 18000);
}

TEST(Doubles_AreRightAboutTheSmallestAndLargestCoordinates) {
  const float coordinates[] = {0.0f, 0x1p-149f, -0x1p-126f, 1.0f, -0x1.fffffep127f, 0x1p127f};
  static const float* any = coordinates;
  const Count count = compare(
      [] {
        const auto one = [] { return any[next_random() % 6u]; };
        const auto point = [one] { return Vec3{one(), one(), one()}; };
        return Case{point(), point(), {point(), point(), point()}};
      },
      5000);
  CHECK_EQ(count.wrong, 0u);
  CHECK(count.decided > 100);
}
