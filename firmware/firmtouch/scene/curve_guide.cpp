#include "firmtouch/scene/curve_guide.hpp"

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/guide_step.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

// -1: past the first end of an open curve, 1: past the last, 0: beside the curve.
int past_end(const curve::View& curve, const curve::Closest& c, Vec3 p_m) {
  if (curve.is_closed()) return 0;
  const float beyond_m = math::dot(p_m - c.point_m, c.tangent);
  if (c.segment == 0 && !(c.arc > 0.0f) && beyond_m < 0.0f) return -1;
  return c.segment + 1 == curve.segment_count() && c.arc >= 1.0f && beyond_m > 0.0f ? 1 : 0;
}

// The nearer end is found by the end samples alone. The guide is there from the next tick on.
void continue_at_other_end(const curve::View& curve, int end, Vec3 p_m, CurveGuideTouch& touch) {
  const uint32_t last = curve.segment_count();
  const float there_m = math::length(p_m - curve.sample(end > 0 ? 0 : last));
  if (!(there_m < touch.closest.distance_m)) return;
  touch.following.arc = end > 0 ? 0.0f : 1.0f;
  touch.following.hint.segment = end > 0 ? 0 : last - 1;
}

Found query(const CurveGuide& guide, Vec3 p_m, query::Budget budget, CurveGuideTouch& touch) {
  const curve::View& curve = *guide.curve;
  Found found;
  found.length_m = curve.head().length_m;
  found.size_m = curve.head().diagonal_m;
  found.is_closed = curve.is_closed();
  touch.following.is_following = touch.is_held;
  const curve::Hold hold{positive(guide.arc_penalty) * found.length_m, release_distance_m(guide)};
  const curve::Followed followed = curve::follow(curve, p_m, hold, budget, touch.following);
  touch.closest = followed.closest;
  found.is_new = followed.is_new;
  found.is_held = followed.is_held;
  found.moved_m = followed.change_of_arc * found.length_m;
  found.behind_m = touch.closest.arc * found.length_m;
  found.ahead_m = found.length_m - found.behind_m;
  found.end = past_end(curve, touch.closest, p_m);
  return found;
}

}  // namespace

void follow_curve(const CurveGuide& guide, Vec3 position_m, query::Budget budget,
                  CurveGuideTouch& touch, servo::LocalModel& model) {
  if (guide.curve == nullptr || !guide.curve->is_open()) {
    touch = {};
    return;
  }
  const Vec3 p_m = math::apply_inverse(guide.pose, position_m);
  const Found found = query(guide, p_m, budget, touch);
  const int end = finish_guide(guide, p_m, found, touch, model);
  if (end != 0) continue_at_other_end(*guide.curve, end, p_m, touch);
}

}  // namespace firmtouch::scene
