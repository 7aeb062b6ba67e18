#include "firmtouch/spline/curve/closest_on_curve.hpp"

#include "firmtouch/query/motion.hpp"
#include "firmtouch/spline/answer.hpp"
#include "firmtouch/spline/curve/search.hpp"
#include "firmtouch/spline/direction.hpp"

namespace firmtouch::spline {
namespace {

using math::Vec3;

// The safe subtree reaches so much of the extent beyond the best point. Of 0.01, 0.015, 0.02 and
// 0.03 ten planar cubics' paths of 0.002 a query took 1,742, 1,726, 1,734 and 1,760 instructions.
constexpr float kSafeSubtreeReach = 0.015f;

// Most tangents need no scaling.
Vec3 tangent_of(Vec3 v) {
  const float length2 = dot(v, v);
  if (!(length2 >= 0x1p-80f && length2 <= 0x1p80f)) return unit_of(v);
  return v * (1.0f / math::square_root(length2));
}

inline Closest answer_near(const View& model, Vec3 p_m, query::Budget budget, CurveHint& hint) {
  const query::Carried carried = query::carry(hint, p_m);
  Best best(model.head());
  CurveSearch search(model, p_m, budget.work, best);
  LeafSafeSubtree safe_subtree{
      {hint.safe_subtree & 0xFFFFu, hint.safe_subtree >> 16},
      carried.is_finite ? query::left_of(hint.safe_subtree_m, carried.motion_m) : 0.0f};
  uint32_t piece;
  float s;
  const bool is_warm = search.resume(hint.foot, piece, s);
  if (is_warm) {
    search.run_warm(piece, s, kSafeSubtreeReach * model.head().extent_m, safe_subtree);
  } else {
    begin_at_first(model, p_m, best);
    search.run_cold(outside_m(model.head(), p_m));
    safe_subtree = {{0xFFFFu, 0xFFFFu}, 0.0f};
  }
  const bool is_first = best.node == query::kNowhere;
  const Vec3 motion_m = is_warm ? p_m - hint.position_m : Vec3{};
  const query::Certificate certificate = certify(model.head(), p_m, best, search, carried, hint);
  hint.foot = is_first ? query::kNowhere : search.foot_after(motion_m);
  hint.safe_subtree = safe_subtree.row.first | safe_subtree.row.last << 16;
  hint.safe_subtree_m = safe_subtree.distance_m;
  return answer_at(model, best, is_first ? 0 : best.node,
                   is_first ? Vec3{} : tangent_of(best.along[0]), certificate);
}

}  // namespace

Closest closest_on_curve(const View& model, Vec3 p_m, query::Budget budget, CurveHint& hint) {
  return is_near(model.head(), p_m) ? answer_near(model, p_m, budget, hint)
                                    : answer_beyond(model, p_m, hint);
}

}  // namespace firmtouch::spline
