// A compiler that leaves roundings out gives tools and oracles other numbers than the firmware's
// queries.
#include "firmtouch/math/vec3.hpp"
#include "harness/test.hpp"

namespace {

using firmtouch::math::Vec3;

struct Wide {
  double x, y, z;
};

[[gnu::noinline]] double mixed(Wide p) { return p.x + 1e-3 * p.y + 1e-6 * p.z; }

[[gnu::noinline]] double next() {
  static double state = 0.1;
  state = state * 1.37 + 0.11;
  if (state > 3) state -= 3;
  return state;
}

Wide wide(Vec3 v) {
  return {static_cast<double>(v.x), static_cast<double>(v.y), static_cast<double>(v.z)};
}

}  // namespace

TEST(ADoubleRoundedToFloatStaysRounded) {
  for (int i = 0; i < 10; ++i) {
    const Vec3 p{static_cast<float>(next()), static_cast<float>(next()),
                 static_cast<float>(next())};
    double twice = 0;
    for (int k = 0; k < 2; ++k) twice += mixed(wide(p));
    volatile float x = p.x, y = p.y, z = p.z;  // through memory
    const Vec3 rounded{x, y, z};
    volatile double once = mixed(wide(rounded));
    CHECK_EQ(twice, 2 * once);
  }
}
