#include "firmtouch/device/serial_arm.hpp"

#include "firmtouch/device/jacobian.hpp"
#include "firmtouch/device/rules.hpp"
#include "firmtouch/math/sine_cosine.hpp"

namespace firmtouch::device {

using core::reject;

core::Verdict check(const SerialArm& arm) {
  if (arm.joints != 2 && arm.joints != 3) return reject(kRuleJointCount);
  for (uint32_t k = 0; k < 2; ++k)
    if (!is_link_length(arm.link_m[k])) return reject(kRuleLinkLength, k);
  const float offsets_m[] = {arm.offset_m, arm.height_m};
  for (uint32_t k = 0; k < 2; ++k) {
    const float offset_m = offsets_m[k];
    if (!is_offset(offset_m) || (arm.joints == 2 && (offset_m < 0.0f || offset_m > 0.0f)))
      return reject(kRuleOffset, k);
  }
  return core::kPassed;
}

Pose pose_of(const SerialArm& arm, const float (&angle_rad)[kMaxJoints]) {
  const uint32_t shoulder = arm.joints - 2;
  const float upper_rad = angle_rad[shoulder];
  const float lower_rad =
      arm.has_parallelogram ? angle_rad[shoulder + 1] : upper_rad + angle_rad[shoulder + 1];
  const math::SineTerms terms;
  const math::SineCosine upper = math::sine_cosine(upper_rad, terms);
  const math::SineCosine lower = math::sine_cosine(lower_rad, terms);
  // In the arm's plane: outward and up.
  const Planar first = Planar{upper.cosine, upper.sine} * arm.link_m[0];
  const Planar second = Planar{lower.cosine, lower.sine} * arm.link_m[1];
  const Planar both = first + second;
  const Planar tip = both + Planar{arm.offset_m, arm.height_m};
  // Motions of the tip by shoulder and elbow; without a parallelogram the shoulder carries the
  // second link too.
  const Planar carried = arm.has_parallelogram ? first : both;
  const Planar by_shoulder{-carried.y, carried.x}, by_elbow{-second.y, second.x};
  if (arm.joints == 2) {
    return {{tip.x, tip.y, 0},
            {{by_shoulder.x, by_shoulder.y, 0}, {by_elbow.x, by_elbow.y, 0}, {}},
            condition_of(by_shoulder, by_elbow),
            true};
  }
  // Column 0 is at right angles to the others, and as long as the tip is far from the axis.
  const math::SineCosine turn = math::sine_cosine(angle_rad[0], terms);
  const math::Vec3 tip_m{tip.x * turn.cosine, tip.x * turn.sine, tip.y};
  const float area = cross(by_shoulder, by_elbow), out2 = tip.x * tip.x;
  const float in_plane2 = dot(by_shoulder, by_shoulder) + dot(by_elbow, by_elbow);
  return {tip_m,
          {{-tip_m.y, tip_m.x, 0},
           {by_shoulder.x * turn.cosine, by_shoulder.x * turn.sine, by_shoulder.y},
           {by_elbow.x * turn.cosine, by_elbow.x * turn.sine, by_elbow.y}},
          unit_ratio(3.0f * __builtin_fabsf(tip.x * area),
                     math::square_root((out2 + in_plane2) * (out2 * in_plane2 + area * area))),
          true};
}

}  // namespace firmtouch::device
