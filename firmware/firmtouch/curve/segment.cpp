#include "firmtouch/curve/segment.hpp"

namespace firmtouch::curve {
namespace {

/// What float32 drops from a - b, exactly (Knuth's two-sum).
float dropped(float a, float b, float difference) {
  const float back = difference - a;
  return (a - (difference - back)) - (b + back);
}

/// What float32 drops from a * b, exactly (Dekker's product of halves of 12 bits).
float dropped_product(float a, float b, float product) {
  const float wide_a = 4097.0f * a, wide_b = 4097.0f * b;
  const float high_a = wide_a - (wide_a - a), high_b = wide_b - (wide_b - b);
  const float low_a = a - high_a, low_b = b - high_b;
  return ((high_a * high_b - product) + high_a * low_b + low_a * high_b) + low_a * low_b;
}

/// One coordinate of p - (a + t (b - a)), and what float32 drops from it.
struct Compensated {
  float value;
  float lost;
};
Compensated compensated_rest(float p, float a, float b, float t) {
  const float from = p - a, along = b - a, part = along * t, rest = from - part;
  const float lost_part = dropped_product(along, t, part) + dropped(b, a, along) * t;
  return {rest, dropped(p, a, from) + dropped(from, part, rest) - lost_part};
}

}  // namespace

float compensated_distance2(math::Vec3 p, math::Vec3 a, math::Vec3 b, float t) {
  const Compensated x = compensated_rest(p.x, a.x, b.x, t), y = compensated_rest(p.y, a.y, b.y, t),
                    z = compensated_rest(p.z, a.z, b.z, t);
  const math::Vec3 rest{x.value, y.value, z.value}, lost{x.lost, y.lost, z.lost};
  return dot(rest, rest) + 2.0f * dot(rest, lost);
}

}  // namespace firmtouch::curve
