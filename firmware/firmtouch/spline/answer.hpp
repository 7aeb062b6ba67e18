#pragma once
// What the queries of curves and of surfaces share, for .cpp files of this module only.
#include "firmtouch/query/coherence.hpp"
#include "firmtouch/spline/closest.hpp"
#include "firmtouch/spline/search.hpp"

namespace firmtouch::spline {

Best best_of(const Head& head);

/// Distance to the box of all control points, rounded down.
float outside_m(const Head& head, math::Vec3 p_m);

/// False for NaN, and for a point that is so far away that all points of the model are equally near
/// to 2^-28.
bool is_near(const Head& head, math::Vec3 p_m);

/// A cold search begins with the middle of the first piece, which takes no evaluation.
void begin_at_first(const View& model, math::Vec3 p_m, Best& best);

/// The answer without direction and certificate.
Closest answer_at(const View& model, const Best& best, uint32_t piece_index);

/// Fills the certificate, and the hint except for position and safe subtree. `pending_m`: bound of
/// what the search left.
void certify(const Head& head, math::Vec3 p_m, const Best& best, bool is_complete, float pending_m,
             uint32_t steps, const query::Carried& carried, Closest& closest, CurveHint& hint);

/// The answer to a point that is not near: the first point, with a bound, or for NaN without one.
Closest answer_beyond(const View& model, math::Vec3 p_m, CurveHint& hint);

}  // namespace firmtouch::spline
