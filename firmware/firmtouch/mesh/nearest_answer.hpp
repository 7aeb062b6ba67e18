#pragma once
// From a search for the nearest triangle to an answer with its certificate. The scalar search and
// the wide one of tools/simd share it. For the library's own translation units.
//
// A Finder has four functions: find<kCompensated>(bound, search) searches and returns whether no
// nearer triangle can be left, direction(best) returns the pseudonormal of the best feature,
// in_box_frame(mesh, p_m) is that of mesh/box_frame.hpp, sign(height_m, doubt_m) returns the sign
// of a height, 0 in doubt. Its kIsForSpeed: whether refined answers, which scans rarely need, are
// compiled for speed instead of size.

#include <float.h>

#include "firmtouch/mesh/box_frame.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/mesh/nearest_search.hpp"
#include "firmtouch/mesh/own_loss.hpp"
#include "firmtouch/query/motion.hpp"

namespace firmtouch::mesh {
namespace {

// Below this distance, relative to the diagonal, either sign is right, and none is carried on.
constexpr float kEitherSide = 2e-6f;

// A lower height above the plane of a pseudonormal, relative to the distance, decides no sign: far
// above the loss of decoding. The baker refuses features whose margin, as stored, is not five times
// this.
constexpr float kDoubt_rad = 6e-5f;

// Margin of a new safe subtree beyond the nearest leaf, in last motions: a smaller one must soon be
// renewed, a larger one holds more triangles. 8 is best of 6, 8, 12 and 16 on the worst touching
// paths (2 % apart).
constexpr float kSafeSubtreeMotions = 8.0f;

// A query farther than this from the origin: squares overflow beyond 1e19, and no model is larger
// than 1e6 m.
constexpr float kBeyond_m = 1e15f;

bool is_slot(const View& mesh, uint32_t slot) {
  if ((slot >> 1) >= mesh.nodes().size()) return false;
  return is_leaf(mesh.sides()[slot].child);
}

// What a search certifies.
struct Found {
  float distance_m;
  float lower_m;  // by this search alone
  bool complete;  // no nearer triangle can be left
};

// Lower bound of all distances before rounding: beyond the band nothing was searched.
float nearest_m(const Search& search) {
  return math::square_root(math::smaller(search.best.distance2_m2, search.band2_m2));
}

// a - b rounded down: a - s is exact where b is the smaller part.
float less_m(float a_m, float b_m) {
  const float s_m = a_m - b_m;
  return a_m - s_m < b_m ? s_m * (1.0f - 0x1p-23f) : s_m;
}

inline void weigh(const Search& search, float lower_m, float rounding_m, Found& found) {
  found.distance_m = math::square_root(search.best.distance2_m2);
  const float pending_m = search.pending_m - rounding_m;
  if (!found.complete && pending_m < lower_m) lower_m = pending_m;
  found.lower_m = math::larger(lower_m, 0.0f);
}

// Measures the nearest triangle of `search`, `nearest`, in double-float, and those rivals that are
// not certified by float32 to be at most `gap_m` nearer, and puts into search.best which of them is
// truly the nearest.
// Result: its distance. `lower_m`: of the rivals that were not measured.
[[gnu::noinline, gnu::cold]] float settle(const View& mesh, const Corners& nearest, Vec3 p_m,
                                          float gap_m, Search& search, float& lower_m) {
  const Loss loss(mesh.head());
  Best& best = search.best;
  float distance_m = nearest.compensated_m(p_m, best.feature, best.distance2_m2);
  lower_m = search.rivals.rest_m;
  for (uint32_t i = 0; i < search.rivals.count; ++i) {
    const float distance2_m2 = search.rivals.distance2_m2[i];
    if (!loss.may_be_less(distance2_m2, distance_m * distance_m)) continue;
    const uint32_t triangle = search.rivals.triangle(i);
    const Feature feature = search.rivals.feature(i);
    const Corners rival(mesh, triangle);
    const float plain_m = math::square_root(distance2_m2);
    const float least_m = plain_m - own_loss_m(loss, rival, feature, plain_m);
    if (distance_m - least_m <= gap_m) {
      lower_m = math::smaller(lower_m, least_m);
      continue;
    }
    const float rival_m = rival.compensated_m(p_m, feature, distance2_m2);
    if (!(rival_m < distance_m)) continue;
    distance_m = rival_m;
    Foot foot;
    find_foot_apart(p_m, {rival.a_m, rival.b_m, rival.c_m}, Nearer::than_nothing(), foot);
    best.offset_m = foot.offset_m;
    best.triangle = triangle;
    best.feature = feature;
  }
  return distance_m;
}

// Whether lower and upper bound, rounding included, lie on one side of the threshold: then no more
// precise distance is needed.
bool is_decided(float threshold_m, float loss_m, Found& found) {
  const float most_m = found.distance_m + loss_m;
  if (!(threshold_m > 0.0f) || !(found.lower_m >= threshold_m || most_m < threshold_m))
    return false;
  found.distance_m = most_m;
  found.complete = false;  // not exact
  return true;
}

// Measures again what float32 may have lost: usually it is far less than its bound.
// Result: whether distance and lower bound are now within `within_m` of each other.
bool measure_again(const View& mesh, float within_m, Search& search, Found& found) {
  const Vec3 p_m = search.p_m;
  if (!found.complete) return false;
  const Loss loss(mesh.head());
  const float near_m = nearest_m(search);
  const Corners nearest(mesh, search.best.triangle);
  if (near_m <= within_m) {  // on the surface, whatever else touches it there: 0 is near enough
    const float distance_m =
        nearest.compensated_m(p_m, search.best.feature, search.best.distance2_m2);
    if (distance_m + loss.compensated_m(distance_m) + loss.rounding_m <= within_m) {
      weigh(search, 0.0f, loss.rounding_m, found);
      found.distance_m = distance_m;
      return true;
    }
  }
  float lower_m, gap_m = 0.0f;
  bool are_all_known = mesh.has_rivals();
  if (are_all_known) {
    // What is no rival is no nearer than near_m: the losses of these triangles alone count.
    const float own_m = best_loss_m(loss, nearest, p_m, search.best, near_m);
    lower_m = math::smaller(near_m - own_m, rivals_lower_m(mesh, loss, search));
    if (near_m - lower_m + own_m <= within_m) {
      weigh(search, lower_m, loss.rounding_m, found);
      return true;
    }
    gap_m = within_m - (loss.rounding_m + 2.0f * loss.compensated_m(near_m));
    // Else those that were let go must be measured.
    are_all_known = near_m - own_m - search.rivals.rest_m <= gap_m;
  }
  if (!are_all_known) search.rivals.clear();
  const float distance_m = settle(mesh, nearest, p_m, gap_m, search, lower_m);
  const float least_m = math::smaller(distance_m, near_m);
  lower_m =
      are_all_known
          ? math::smaller(lower_m, less_m(least_m, loss.compensated_m(least_m) + loss.rounding_m))
          : less_m(near_m, loss.plain_m(near_m) + loss.rounding_m);
  weigh(search, lower_m, loss.rounding_m, found);
  const float max_m = distance_m + loss.compensated_m(distance_m) + loss.rounding_m;
  if (!(max_m - found.lower_m <= within_m)) return false;
  found.distance_m = distance_m;
  return true;
}

// The nearest of a search.
struct Nearest {
  Best best;
  uint32_t parts, charged;
};

// If that is not enough, the search runs again in double-float, from the nearest leaf.
template <class Finder, class Bound>
[[gnu::noinline]] void search_again(const View& mesh, const Finder& finder, const Bound& bound,
                                    uint32_t budget, Search& search, Found& found) {
  const Loss loss(mesh.head());
  const Nearest before{search.best, search.parts, search.charged};
  const bool has_budget = found.complete && budget > search.parts;
  found.complete = false;
  if (has_budget) {
    // The nearest triangle is no farther than this: in its leaf only near ties are measured again.
    const float upper_m = found.distance_m + 2.0f * loss.plain_m(found.distance_m);
    search.best.distance2_m2 = upper_m * upper_m * (1.0f + 0x1p-22f);
    search.start = search.best.slot;
    search.best.slot = query::kNowhere;
    search.budget = budget - search.parts;
    found.complete = finder.template find<true>(bound, search);
    search.parts += before.parts;
    search.charged += before.charged;
  }
  if (found.complete) {
    const float near_m = nearest_m(search);
    const float lower_m = less_m(near_m, loss.compensated_m(near_m) + loss.rounding_m);
    return weigh(search, lower_m, loss.rounding_m, found);
  }
  // No budget left for it: return the true distance of the triangle that was found.
  search.best = before.best;
  if (search.best.slot == query::kNowhere) return;
  const Corners corners(mesh, search.best.triangle);
  found.distance_m =
      corners.compensated_m(search.p_m, search.best.feature, search.best.distance2_m2);
}

// Where float32 does not promise `within_m`. By value: a reference would keep `found` of every
// query in memory. Inlined: two floats that a call takes in one register wait for their stores.
template <class Finder, class Bound>
[[gnu::always_inline]] inline Found refined_fast(const View& mesh, Finder finder,
                                                 const Bound& bound, uint32_t budget,
                                                 float threshold_m, float within_m, float loss_m,
                                                 Search& search, Found found) {
  if (!is_decided(threshold_m, loss_m, found) && !measure_again(mesh, within_m, search, found))
    search_again(mesh, finder, bound, budget, search, found);
  return found;
}
// The same for size, as GCC makes a cold function.
template <class Finder, class Bound>
[[gnu::noinline, gnu::cold]] Found refined_small(const View& mesh, Finder finder,
                                                 const Bound& bound, uint32_t budget,
                                                 float threshold_m, float within_m, float loss_m,
                                                 Search& search, Found found) {
  if (!is_decided(threshold_m, loss_m, found) && !measure_again(mesh, within_m, search, found))
    search_again(mesh, finder, bound, budget, search, found);
  return found;
}
template <class Finder, class Bound>
constexpr auto* kRefined =
    Finder::kIsForSpeed ? refined_fast<Finder, Bound> : refined_small<Finder, Bound>;

// The sign of the offset, or 0 if the roundings of offset, `loss_m`, and pseudonormal could change
// it.
template <class Finder>
int8_t sign_of(const Finder& finder, Vec3 offset_m, float distance_m, Vec3 direction, float loss_m,
               float diagonal_m) {
  const float height_m = dot(offset_m, direction);
  const float doubt_m = kDoubt_rad * distance_m + loss_m;
  const int side = finder.sign(height_m, doubt_m);
  if (side != 0) return static_cast<int8_t>(side);
  if (distance_m > kEitherSide * diagonal_m) return 0;
  return height_m >= 0.0f ? 1 : -1;
}

// What the next query may use of this one.
[[gnu::always_inline]] inline void leave_hint(const Search& search, float lower_m, int8_t sign,
                                              Hint& hint) {
  const Best& best = search.best;
  if (best.slot != query::kNowhere) hint.leaf_slot = best.slot;
  hint.triangle_low = static_cast<uint16_t>(best.triangle);
  hint.lower_m = lower_m;
  hint.sign = sign;
  hint.safe_subtree = search.safe_subtree;
  hint.safe_subtree_m = search.safe_subtree_m;
}

template <class Finder, class Bound>
[[gnu::always_inline]] inline Closest answer(const View& mesh, const Finder& finder,
                                             const Bound& bound, const Vec3& p_m,
                                             const query::Budget& budget, Hint& hint) {
  const float moved_m = query::motion_m(hint, p_m);
  hint.position_m.x = p_m.x;
  hint.position_m.y = p_m.y;
  hint.position_m.z = p_m.z;
  const Loss loss(mesh.head());
  const float safe_subtree_margin_m = kSafeSubtreeMotions * moved_m;
  // FLT_MAX, or a square beyond it: no band.
  const float band_m = math::larger(budget.band_m, 0.0f), band2_m2 = band_m * band_m;
  const uint32_t slot = hint.leaf_slot, safe_subtree = hint.safe_subtree;
  Search search;  // set without reads between, else its defaults are stored too
  search.p_m.x = p_m.x;
  search.p_m.y = p_m.y;
  search.p_m.z = p_m.z;
  search.budget = parts_of(budget.work);
  search.band2_m2 = math::smaller(band2_m2, FLT_MAX);
  search.safe_subtree_margin_m = safe_subtree_margin_m;
  search.safe_subtree = safe_subtree;
  search.safe_subtree_m = query::left_of(hint.safe_subtree_m, moved_m);
  search.slack_m2 = Nearer::slack_m2(loss.longest_edge_m);
  // After a jump farther than the band the last leaf does not help.
  if (!(safe_subtree_margin_m > budget.band_m) && is_slot(mesh, slot)) {
    search.start = slot;
  } else {  // a stored vertex is a point of the surface before any triangle is reached
    search.start = query::kNowhere;
    search.best.offset_m = p_m - mesh.vertex(mesh.triangle(0).corner[0]);
    search.best.distance2_m2 = dot(search.best.offset_m, search.best.offset_m);
  }
  Found found;
  found.complete = finder.template find<Bound::kCompensated>(bound, search);
  const float plain_m = nearest_m(search);
  const float plain_loss_m = loss.reported_m(plain_m);
  const float loss_m = plain_loss_m + loss.rounding_m;
  weigh(search,
        Bound::kCompensated ? less_m(plain_m, loss.compensated_m(plain_m) + loss.rounding_m)
                            : plain_m - loss_m,
        loss.rounding_m, found);
  const float diagonal_m = mesh.head().diagonal_m;
  const bool is_near = search.best.distance2_m2 <= search.band2_m2;
  const float promise_m = kPromise * math::larger(plain_m, diagonal_m);
  bool exact = false;
  if (is_near) {
    if (!Bound::kCompensated && !(2.0f * loss_m <= promise_m))
      found = kRefined<Finder, Bound>(mesh, finder, bound, parts_of(budget.work),
                                      budget.threshold_m, promise_m, loss_m, search, found);
    exact = found.complete;
  }

  const Best& best = search.best;
  const Vec3 point_m = bound.foot_m(mesh, p_m, best.offset_m, best.triangle);
  const Vec3 direction = finder.direction(best);
  // The carried bound may be higher only if the search was cut short.
  float lower_m = found.lower_m;
  if (!exact) {
    const float carried_m = query::lower_left_of(hint.lower_m, moved_m);
    if (carried_m > lower_m) lower_m = carried_m;
  }
  int8_t sign = 0;
  if (mesh.is_signed()) {
    if (bound.is_outside())
      sign = 1;
    else if (exact)
      sign = sign_of(finder, best.offset_m, found.distance_m, direction, plain_loss_m, diagonal_m);
    if (sign == 0) {  // the last sign, if the path stayed within certified free distance
      if (query::left_of(hint.lower_m, moved_m) > 0.0f) sign = hint.sign;
      exact = exact && sign != 0;
    }
  }
  leave_hint(search, lower_m, lower_m > kEitherSide * diagonal_m ? sign : int8_t{0}, hint);
  return {
      sign < 0 ? -found.distance_m : found.distance_m,
      {point_m.x, point_m.y, point_m.z},
      {direction.x, direction.y, direction.z},
      best.triangle,
      best.feature,
      {lower_m, search.parts - search.charged, exact, sign, units_of(search.parts, budget.work)}};
}

// So far away that every vertex is as near as any other to 4e-8: no square of such a distance fits
// a float.
Closest answer_beyond(const View& mesh, Vec3 p_m, Hint& hint) {
  Closest closest;
  closest.point_m = mesh.vertex(mesh.triangle(0).corner[0]);
  closest.direction = unit(Vec3{p_m.x * 0x1p-100f, p_m.y * 0x1p-100f, p_m.z * 0x1p-100f});
  closest.feature = Feature::kVertex0;
  closest.certificate.steps = closest.certificate.work = 1;
  const float scaled = math::length((p_m - closest.point_m) * 0x1p-70f);
  const bool fits = scaled < 0x1.ffffp57f;
  closest.distance_m = fits ? scaled * 0x1p70f : FLT_MAX;
  closest.certificate.lower_m = fits ? closest.distance_m * (1.0f - 0x1p-22f) : 0x1.fff0p127f;
  closest.certificate.exact = fits;
  closest.certificate.sign = mesh.is_signed() ? 1 : 0;
  hint.position_m = p_m;
  hint.lower_m = closest.certificate.lower_m;
  hint.sign = closest.certificate.sign;
  hint.safe_subtree = query::kNowhere;
  return closest;
}

Closest answer_nothing(const View& mesh, Hint& hint) {
  Closest closest;
  closest.point_m = mesh.vertex(mesh.triangle(0).corner[0]);
  closest.direction = {0, 0, 1};
  closest.distance_m = FLT_MAX;
  closest.feature = Feature::kVertex0;
  hint.lower_m = 0;
  hint.sign = 0;
  hint.safe_subtree = query::kNowhere;
  return closest;
}

// Outside the grid, or nowhere. Rare, so for size.
template <class Finder>
[[gnu::noinline, gnu::cold]] Closest answer_far(const View& mesh, Finder finder, Vec3 p_m,
                                                query::Budget budget, Hint& hint) {
  if (!math::is_finite(p_m)) return answer_nothing(mesh, hint);
  if (!(math::dot(p_m * (1.0f / kBeyond_m), p_m * (1.0f / kBeyond_m)) <= 1.0f))
    return answer_beyond(mesh, p_m, hint);
  FarBound bound;
  bound.begin(mesh.head(), in_box_frame(mesh, p_m));
  return answer(mesh, finder, bound, p_m, budget, hint);
}

// The whole query. `finder` as above.
template <class Finder>
[[gnu::always_inline]] inline Closest closest_by(const View& mesh, const Finder& finder, Vec3 p_m,
                                                 query::Budget budget, Hint& hint) {
  NearBound near_bound;
  if (near_bound.begin(mesh.head(), finder.in_box_frame(mesh, p_m)))
    return answer(mesh, finder, near_bound, p_m, budget, hint);
  return answer_far(mesh, finder, p_m, budget, hint);
}

}  // namespace
}  // namespace firmtouch::mesh
