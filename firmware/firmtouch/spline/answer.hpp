#pragma once
// What the queries of curves and of surfaces share, for .cpp files of this module only.
#include "firmtouch/query/coherence.hpp"
#include "firmtouch/spline/closest.hpp"
#include "firmtouch/spline/search.hpp"

namespace firmtouch::spline {

/// Distance to the box of all control points, rounded down.
float outside_m(const Head& head, math::Vec3 p_m);

/// False for NaN, and for a point that is so far away that all points of the model are equally near
/// to 2^-28.
static inline bool is_near(const Head& head, math::Vec3 p_m) {
  const float far_m = head.extent_m * 0x1p28f;
  return __builtin_fabsf(p_m.x - head.low_m[0]) <= far_m &&
         __builtin_fabsf(p_m.y - head.low_m[1]) <= far_m &&
         __builtin_fabsf(p_m.z - head.low_m[2]) <= far_m;
}

/// A cold search begins with the middle of the first piece, which takes no evaluation.
void begin_at_first(const View& model, math::Vec3 p_m, Best& best);

/// The answer where the best point is.
Closest answer_at(const View& model, const Best& best, uint32_t piece_index, math::Vec3 direction,
                  const query::Certificate& certificate);

/// Returns the certificate, and fills the hint except for position and safe subtree.
query::Certificate certify(const Head& head, math::Vec3 p_m, const Best& best,
                           const Account& search, float pending_m, const query::Carried& carried,
                           CurveHint& hint);
template <class Search>
query::Certificate certify(const Head& head, math::Vec3 p_m, const Best& best, const Search& search,
                           const query::Carried& carried, CurveHint& hint) {
  const float pending_m = search.is_complete() ? 0.0f : search.pending_m(outside_m(head, p_m));
  return certify(head, p_m, best, search, pending_m, carried, hint);
}

/// The answer to a point that is not near: the first point, with a bound, or for NaN without one.
Closest answer_beyond(const View& model, math::Vec3 p_m, CurveHint& hint);

}  // namespace firmtouch::spline
