#include "firmtouch/spline/surface/closest_on_surface.hpp"

#include "firmtouch/query/motion.hpp"
#include "firmtouch/spline/answer.hpp"
#include "firmtouch/spline/direction.hpp"
#include "firmtouch/spline/surface/search.hpp"

namespace firmtouch::spline {
namespace {

using math::Vec3;

// A new frontier reaches this many of the last motions beyond the nearest point, or so much of the
// extent.
constexpr float kFrontierMotions = 8.0f, kMinReach = 0x1p-10f;

// Every node of a frontier comes nearer by the motion at most. Four roundings, of what is not
// larger than either.
void move(const Vec3& p_m, const CurveHint& hint, Frontier& frontier) {
  const float motion_m = query::motion_m(hint, p_m);
  if (!(motion_m <= query::kMaxMotion_m)) {
    FrontierUse(frontier).clear();
    return;
  }
  const float lost_m = __builtin_fabsf(frontier.base_m) + motion_m;
  frontier.base_m = frontier.base_m - motion_m - lost_m * (4.0f * kUnit);
}

// Of the two derivatives; none where these, beside a pole, are little more than what float32 loses
// of them: from that on the normal is within 25 degrees.
Vec3 normal_of(const Best& best, float loss_m) {
  const Vec3 normal = cross(best.along[0], best.along[1]);
  const float lost = kSlopeNoise * loss_m * (size_of(best.along[0]) + size_of(best.along[1]));
  return size_of(normal) > 4.0f * lost ? unit_of(normal) : Vec3{};
}

// `safe_subtree`: what the hint stores, kWithFrontier where the frontier is stored too.
Closest answer(const View& model, Vec3 p_m, query::Budget budget, CurveHint& hint,
               Frontier& frontier, uint32_t safe_subtree) {
  if (!is_near(model.head(), p_m)) {
    FrontierUse(frontier).clear();
    return answer_beyond(model, p_m, hint);
  }
  const query::Carried carried = query::carry(hint, p_m);
  BandedBest best(model.head(), budget.band_m);
  SurfaceSearch search(model, p_m, budget.work, best);
  if (hint.safe_subtree != kWithFrontier) FrontierUse(frontier).clear();
  move(p_m, hint, frontier);
  uint32_t leaf;
  Rectangle range;
  const bool is_warm = search.resume(hint, leaf, range);
  if (is_warm) {
    const float min_m = kMinReach * model.head().extent_m;
    search.run_warm(leaf, range, math::larger(kFrontierMotions * carried.motion_m, min_m),
                    frontier);
  } else {
    begin_at_first(model, p_m, best);
    search.run_cold(outside_m(model.head(), p_m));
    FrontierUse(frontier).clear();
  }
  const bool is_first = best.node == query::kNowhere;
  const Vec3 motion_m = is_warm ? p_m - hint.position_m : Vec3{};
  query::Certificate certificate = certify(model.head(), p_m, best, search, carried, hint);
  if (best.is_beyond_band()) certificate.exact = false;
  hint.foot = query::kNowhere;
  if (!is_first) search.leave(motion_m, hint);
  hint.safe_subtree = safe_subtree;
  hint.safe_subtree_m = 0.0f;
  return answer_at(model, best, is_first ? 0 : search.piece_of(best.node),
                   is_first ? Vec3{} : normal_of(best, model.head().loss_m), certificate);
}

}  // namespace

Closest closest_on_surface(const View& model, Vec3 p_m, query::Budget budget, Hint& hint) {
  return answer(model, p_m, budget, hint, hint.frontier, kWithFrontier);
}

Closest closest_on_surface(const View& model, Vec3 p_m, query::Budget budget, CurveHint& hint) {
  Frontier frontier;
  return answer(model, p_m, budget, hint, frontier, query::kNowhere);
}

}  // namespace firmtouch::spline
