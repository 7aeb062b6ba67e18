#include "firmtouch/scene/spline_guide.hpp"

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/guide_step.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

Found query(const SplineGuide& guide, Vec3 p_m, query::Budget budget, SplineGuideTouch& touch) {
  const spline::GuideView& curve = *guide.spline;
  touch.following.is_following = touch.is_held;
  const spline::Hold hold{positive(guide.arc_penalty) * curve.length_m(),
                          release_distance_m(guide)};
  const spline::Followed followed = spline::follow(curve, p_m, hold, budget, touch.following);
  touch.closest.distance_m = followed.closest.distance_m;
  touch.closest.point_m = followed.closest.point_m;
  touch.closest.tangent = followed.closest.direction;
  touch.closest.segment = followed.closest.bezier;
  touch.closest.arc = followed.arc;
  touch.closest.certificate = followed.closest.certificate;
  Found found;
  found.is_new = followed.is_new;
  found.is_held = followed.is_held;
  found.is_closed = followed.is_chain_closed;
  found.moved_m = followed.change_of_arc * curve.length_m();
  found.behind_m = followed.behind_m;
  found.ahead_m = followed.ahead_m;
  found.length_m = followed.behind_m + followed.ahead_m;
  found.size_m = curve.model().head().extent_m;
  found.end = followed.end;
  return found;
}

}  // namespace

void follow_spline(const SplineGuide& guide, Vec3 position_m, query::Budget budget,
                   SplineGuideTouch& touch, servo::LocalModel& model) {
  if (guide.spline == nullptr || !guide.spline->is_open()) {
    touch = {};
    return;
  }
  const Vec3 p_m = math::apply_inverse(guide.pose, position_m);
  const Found found = query(guide, p_m, budget, touch);
  const int end = finish_guide(guide, p_m, found, touch, model);
  if (end != 0)
    spline::go_on_at_other_end(*guide.spline, end, p_m, touch.closest.distance_m, touch.following);
}

}  // namespace firmtouch::scene
