#include "firmtouch/field/closest_point.hpp"

#include "firmtouch/query/coherence.hpp"

namespace firmtouch::field {
namespace {

using math::Vec3;

// The field's bounds of p, as if a query had left them.
void leave_hint(const Bounds& bounds, Vec3 p_m, mesh::Hint& hint) {
  hint.leaf_slot = bounds.seed;
  hint.position_m = p_m;
  hint.lower_m = bounds.lower_m;
  hint.sign = bounds.sign;
  hint.safe_subtree = query::kNowhere;
  hint.safe_subtree_m = 0;
}

// The cell's seed if the last leaf is too far; the larger of the certified bounds.
void start_at_seed(const Bounds& bounds, float cell_m, Vec3 p_m, mesh::Hint& hint) {
  const query::Carried carried = query::carry(hint, p_m);
  if (hint.leaf_slot != query::kNowhere && carried.motion_m <= cell_m) return;
  leave_hint(bounds, p_m, hint);
  if (carried.lower_m > bounds.lower_m) {
    hint.lower_m = carried.lower_m;
    hint.sign = carried.sign;
  }
}

// Bound and sign that a search left open at the end of its budget or band.
void stand_in(const Bounds& bounds, mesh::Closest& closest, mesh::Hint& hint) {
  query::Certificate& certificate = closest.certificate;
  if (bounds.lower_m > certificate.lower_m) certificate.lower_m = hint.lower_m = bounds.lower_m;
  if (certificate.sign != 0 || bounds.sign == 0) return;
  certificate.sign = hint.sign = bounds.sign;
  if (bounds.sign < 0) closest.distance_m = -closest.distance_m;
}

}  // namespace

Answer closest_point(const View& distance_field, const mesh::View& mesh, Vec3 p_m, float band_m,
                     query::Budget budget, mesh::Hint& hint) {
  const Bounds bounds = distance_bounds(distance_field, p_m);
  Answer answer;
  if (bounds.lower_m > band_m && bounds.sign >= 0) {
    leave_hint(bounds, p_m, hint);
    answer.is_far = true;
    answer.closest.distance_m = bounds.upper_m;
    answer.closest.certificate.lower_m = bounds.lower_m;
    answer.closest.certificate.sign = bounds.sign;
    answer.closest.certificate.steps = answer.closest.certificate.work = 1;
    return answer;
  }
  start_at_seed(bounds, distance_field.head().cell_m, p_m, hint);
  answer.closest = mesh::closest_point(mesh, p_m, budget, hint);
  if (!answer.closest.certificate.exact) stand_in(bounds, answer.closest, hint);
  return answer;
}

}  // namespace firmtouch::field
