#include "firmtouch/device/five_bar.hpp"

#include "firmtouch/device/jacobian.hpp"
#include "firmtouch/device/rules.hpp"
#include "firmtouch/math/isa.hpp"
#include "firmtouch/math/sine_cosine.hpp"

namespace firmtouch::device {
namespace {

using core::reject;

Planar turned(Planar a) { return {-a.y, a.x}; }  // a quarter turn to the left

}  // namespace

core::Verdict check(const FiveBar& bar) {
  if (!(bar.base_m >= 0.0f) || !is_offset(bar.base_m)) return reject(kRuleOffset);
  for (uint32_t k = 0; k < 2; ++k) {
    if (!is_link_length(bar.proximal_m[k])) return reject(kRuleLinkLength, k);
    if (!is_link_length(bar.distal_m[k])) return reject(kRuleLinkLength, 2 + k);
  }
  // The elbows' distance: from at least `nearest` to `farthest`. The tip closes it from the
  // difference of the distal links to their sum.
  const float proximal = bar.proximal_m[0] + bar.proximal_m[1];
  const float difference = bar.distal_m[0] - bar.distal_m[1];
  const float farthest = bar.base_m + proximal;
  float nearest = bar.base_m - proximal;
  const float longer = bar.proximal_m[0] - bar.proximal_m[1];
  if (longer - bar.base_m > nearest) nearest = longer - bar.base_m;
  if (-longer - bar.base_m > nearest) nearest = -longer - bar.base_m;
  if (!(nearest < bar.distal_m[0] + bar.distal_m[1]) ||
      !(farthest > (difference < 0.0f ? -difference : difference)))
    return reject(kRuleNeverCloses);
  return core::kPassed;
}

Pose pose_of(const FiveBar& bar, const float (&angle_rad)[kMaxJoints]) {
  const math::SineTerms terms;
  const math::SineCosine left = math::sine_cosine(angle_rad[0], terms);
  const math::SineCosine right = math::sine_cosine(angle_rad[1], terms);
  const Planar link0 = Planar{left.cosine, left.sine} * bar.proximal_m[0];
  const Planar link1 = Planar{right.cosine, right.sine} * bar.proximal_m[1];
  // Circles of the distal links about the elbows. `along` is a share of the way between them,
  // `height` in units of it.
  const Planar elbow = link0 - Planar{0.5f * bar.base_m, 0};
  const Planar way = link1 - link0 + Planar{bar.base_m, 0};
  const float way2 = dot(way, way);
  const float first2 = bar.distal_m[0] * bar.distal_m[0];
  const float second2 = bar.distal_m[1] * bar.distal_m[1];
  const float inverse = way2 > 1e-12f ? 1.0f / way2 : 0.0f;
  // From the elbow of the shorter one: the longer one's square would round away what it has.
  const bool is_second = second2 < first2;
  const float longer2 = is_second ? first2 : second2, shorter2 = is_second ? second2 : first2;
  const float along = 0.5f + 0.5f * (shorter2 - longer2) * inverse;
  const float height2 = shorter2 * inverse - along * along;
  const bool is_reachable = height2 > 0.0f;
  const float root = is_reachable ? math::square_root(height2) : 0.0f;
  const float height = bar.is_tip_left ? root : -root;
  const Planar distal0 = way * (is_second ? 1.0f - along : along) + turned(way) * height;
  const Planar distal1 = distal0 - way;
  const Planar tip = elbow + distal0;

  // distal . (tip' - turned(link) rate) = 0 for both: the columns by Cramer's rule.
  const float per_area = 1.0f / cross(distal0, distal1);
  const Planar column0 = turned(distal1) * (cross(distal0, link0) * per_area);
  const Planar column1 = turned(distal0) * (-cross(distal1, link1) * per_area);
  const float condition = condition_of(column0, column1);
  const math::Vec3 tip_m{tip.x, tip.y, 0};
  // Out of reach both distal links are on one line, and the condition is 0 or NaN.
  if (!(condition >= kSingular)) return {tip_m, {}, 0, is_reachable};
  return {tip_m, {{column0.x, column0.y, 0}, {column1.x, column1.y, 0}, {}}, condition, true};
}

}  // namespace firmtouch::device
