#include "exact_oracle.hpp"
#include "harness/test.hpp"
#include "surface/exact_side.hpp"
#include "surface/random.hpp"

namespace firmtouch::tools {
namespace {

float any_float(Random& random, int spread) {
  const double size = std::ldexp(random.between(-1, 1),
                                 -static_cast<int>(random.below(static_cast<uint32_t>(spread))));
  return static_cast<float>(size);
}

math::Vec3 any_point(Random& random, int spread) {
  return {any_float(random, spread), any_float(random, spread), any_float(random, spread)};
}

}  // namespace

TEST(SidesOfWholeNumbersEqual128BitArithmetic) {
  Random random(1);
  int zeros = 0;
  for (int k = 0; k < 200000; ++k) {
    test::note("case", k);
    int64_t at[4][3];
    for (auto& point : at) {
      for (int64_t& value : point)
        value = static_cast<int64_t>(random.below(k % 2 == 0 ? 5 : 9000000)) - 2;
    }
    if (k % 3 == 0) {  // nearly on the plane, or on it
      for (int i = 0; i < 3; ++i)
        at[3][i] = at[0][i] + at[1][i] - at[2][i] + (k % 9 == 0 && i == 0);
    }
    math::Vec3 v[4];
    bool fits = true;
    for (int p = 0; p < 4; ++p) {
      v[p] = {static_cast<float>(at[p][0]), static_cast<float>(at[p][1]),
              static_cast<float>(at[p][2])};
      for (int i = 0; i < 3; ++i) fits = fits && std::abs(at[p][i]) < (1 << 24);
    }
    if (!fits) continue;
    __extension__ typedef __int128 Wide;
    Wide d[3][3];
    for (int p = 0; p < 3; ++p) {
      for (int i = 0; i < 3; ++i) d[p][i] = at[p + 1][i] - at[0][i];
    }
    const Wide all = d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) -
                     d[0][1] * (d[1][0] * d[2][2] - d[1][2] * d[2][0]) +
                     d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
    const int wanted = all > 0 ? 1 : all < 0 ? -1 : 0;
    CHECK_EQ(exact_side(v[0], v[1], v[2], v[3]), wanted);
    CHECK_EQ(exact_sign(v[0], v[1], v[2], spot_at(v[3])), wanted);
    zeros += wanted == 0 ? 1 : 0;
  }
  CHECK_LT(20000, zeros);
}

TEST(SidesOfFloatsOfAnySizeEqualLongSums) {
  Random random(2);
  for (int k = 0; k < 100000; ++k) {
    test::note("case", k);
    const int spread = k % 4 == 0 ? 140 : k % 4 == 1 ? 40 : 3;
    const math::Vec3 a = any_point(random, spread), b = any_point(random, spread),
                     c = any_point(random, spread);
    const double s = random.uniform(), t = random.uniform();
    // As near to the plane as a float comes.
    const math::Vec3 p =
        to_vec3(to_point(a) + (to_point(b) - to_point(a)) * s + (to_point(c) - to_point(a)) * t);
    const int side = exact_side(a, b, c, p);
    CHECK_EQ(side, exact_sign(a, b, c, spot_at(p)));
    CHECK_EQ(side, exact_side(b, c, a, p));
    CHECK_EQ(side, -exact_side(b, a, c, p));
    CHECK_EQ(side, -exact_side(p, b, c, a));
    CHECK_EQ(exact_side(a, b, c, c), 0);
  }
}

}  // namespace firmtouch::tools
