#include "firmtouch/device/delta.hpp"

#include "firmtouch/device/arms.hpp"
#include "firmtouch/device/jacobian.hpp"
#include "firmtouch/device/rules.hpp"
#include "firmtouch/math/sine_cosine.hpp"

namespace firmtouch::device {
namespace {

using core::reject;
using math::Vec3;

// `end` is where the lower link would begin if the platform were a point; `swing` its motion per
// radian.
struct Arm {
  Vec3 end, swing;
};

template <uint32_t k>
Arm arm_of(const Delta& delta, float out_m, float angle_rad, const math::SineTerms& terms) {
  const math::SineCosine turn = math::sine_cosine(angle_rad, terms);
  const float across = delta.upper_m[k] * turn.cosine, up = delta.upper_m[k] * turn.sine;
  const float radial = out_m + across;
  return {{radial * kCosine[k] - delta.side_m * kSine[k],
           radial * kSine[k] + delta.side_m * kCosine[k], up},
          {-up * kCosine[k], -up * kSine[k], across}};
}

float size(float a) { return a < 0.0f ? -a : a; }

}  // namespace

core::Verdict check(const Delta& delta) {
  const float offsets_m[] = {delta.base_radius_m, delta.platform_radius_m, delta.side_m};
  for (uint32_t k = 0; k < 3; ++k) {
    if (!is_link_length(delta.upper_m[k])) return reject(kRuleLinkLength, k);
    if (!is_link_length(delta.lower_m[k])) return reject(kRuleLinkLength, 3 + k);
    if (!is_offset(offsets_m[k])) return reject(kRuleOffset, k);
  }
  // The end of an upper link comes to the platform on z as near as this.
  const float out_m = size(delta.base_radius_m - delta.platform_radius_m);
  for (uint32_t k = 0; k < 3; ++k) {
    const float inner_m = out_m > delta.upper_m[k] ? out_m - delta.upper_m[k] : 0.0f;
    if (!(inner_m * inner_m + delta.side_m * delta.side_m < delta.lower_m[k] * delta.lower_m[k]))
      return reject(kRuleNeverCloses, k);
  }
  return core::kPassed;
}

Pose pose_of(const Delta& delta, const float (&angle_rad)[kMaxJoints]) {
  const float out_m = delta.base_radius_m - delta.platform_radius_m;
  const math::SineTerms terms;
  const Arm arm0 = arm_of<0>(delta, out_m, angle_rad[0], terms);
  const Arm arm1 = arm_of<1>(delta, out_m, angle_rad[1], terms);
  const Arm arm2 = arm_of<2>(delta, out_m, angle_rad[2], terms);
  // The three spheres of the lower links about the ends meet at arm0.end + flat + lift * normal,
  // where flat . u = a and flat . v = b.
  const Vec3 u = arm1.end - arm0.end, v = arm2.end - arm0.end;
  const Vec3 normal = math::cross(u, v);
  const float normal2 = math::dot(normal, normal);
  const float inverse = normal2 > 1e-24f ? 1.0f / normal2 : 0.0f;
  const float first2 = delta.lower_m[0] * delta.lower_m[0];
  const float a = 0.5f * (first2 - delta.lower_m[1] * delta.lower_m[1] + math::dot(u, u));
  const float b = 0.5f * (first2 - delta.lower_m[2] * delta.lower_m[2] + math::dot(v, v));
  const Vec3 flat = math::cross(v * a - u * b, normal) * inverse;
  const float lift2 = (first2 - math::dot(flat, flat)) * inverse;
  const bool is_reachable = lift2 > 0.0f;
  const float root = is_reachable ? math::square_root(lift2) : 0.0f;
  const Vec3 lift = normal * (delta.is_tip_above ? root : -root);
  const Vec3 rod0 = flat + lift, rod1 = rod0 - u, rod2 = rod0 - v;
  const Vec3 tip_m = arm0.end + rod0;

  // rod . (tip' - swing rate) = 0 for all three: the columns by Cramer's rule.
  const float push0 = math::dot(rod0, arm0.swing);
  const float push1 = math::dot(rod1, arm1.swing);
  const float push2 = math::dot(rod2, arm2.swing);
  const Vec3 opposite = math::cross(rod1, rod2);
  const float per_volume = 1.0f / math::dot(rod0, opposite);
  const Vec3 column0 = opposite * (push0 * per_volume);
  const Vec3 column1 = math::cross(rod2, rod0) * (push1 * per_volume);
  const Vec3 column2 = math::cross(rod0, rod1) * (push2 * per_volume);
  // Rows of the inverse are rod / push, and a rod is as long as its link.
  const float row0 = delta.lower_m[0] / push0, row1 = delta.lower_m[1] / push1;
  const float row2 = delta.lower_m[2] / push2;
  const float columns =
      math::dot(column0, column0) + math::dot(column1, column1) + math::dot(column2, column2);
  const float rows = row0 * row0 + row1 * row1 + row2 * row2;
  const float condition = unit_ratio(3.0f, math::square_root(columns * rows));
  if (!is_reachable || !(condition >= kSingular)) return {tip_m, {}, 0, is_reachable};
  return {tip_m, {column0, column1, column2}, condition, true};
}

}  // namespace firmtouch::device
