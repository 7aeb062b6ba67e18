#include "firmtouch/mesh/closest_point.hpp"

#include <float.h>

#include "firmtouch/core/hash.hpp"
#include "firmtouch/mesh/grid.hpp"
#include "firmtouch/mesh/pseudonormal.hpp"
#include "firmtouch/mesh/triangle.hpp"
#include "firmtouch/query/coherence.hpp"

namespace firmtouch::mesh {
namespace {

using math::Vec3;

// Boxes still to be looked at. Best box first while there is room for a whole descent, last in
// first out beyond, which needs kMaxDepth entries at most. 64 entries for best-first: with the 64
// steps that touch uses it never overflows.
constexpr uint32_t kBestFirst = 64;
constexpr uint32_t kCapacity = kBestFirst + kMaxDepth;

// What float32 can lose in a triangle's distance, beside max(diagonal, distance): measured at
// most 1.6e-7 on the real models and 2.2e-7 on hostile triangles
// (tests/mesh/triangle_host_test.cpp), told as 3.5e-7, promised as 4e-7.
constexpr float kDistanceError = 2e-7f;

// A new fence stands this many of the last motions beyond the nearest leaf: nearer, it must soon be
// renewed; farther, more lies inside it.
constexpr float kFenceMotions = 16.0f;

// A query farther than this from the origin: squares overflow beyond 1e19, and no model is larger
// than 1e6 m.
constexpr float kBeyond_m = 1e15f;

struct Best {
  float distance2_m2 = FLT_MAX;
  Vec3 offset_m;
  uint32_t triangle = 0;
  uint32_t place = query::kNowhere;  // of its leaf: node << 1 | slot
  Feature feature = Feature::kVertex0;
};

// A place is a box: node << 1 | which of its two.
struct Pending {
  uint32_t key;
  uint32_t place;
};

struct Search {
  Best best;
  uint32_t fence = query::kNowhere;  // in: the subtree outside which all is at least fence_m away;
                                     // out: the same, renewed
  float fence_m = 0;
  float fence_margin_m = 0;  // how much farther than the last leaf a new fence should be
  uint32_t steps = 0;
  bool complete = false;  // nothing nearer can be left
  float pending_m =
      0;  // where it is not complete: certified distance to everything that was not looked at
};

// The last key below `prune`; beyond `best_first` entries any such, up to there the smallest.
// Result: false when there is none. A cold search takes the smallest, for the sake of its lower
// bound; a warm one knows its upper bound so well that the order no longer matters, and saves the
// comparisons.
inline bool take_next(Pending* pending, uint32_t& count, uint32_t best_first, uint32_t prune,
                      Pending& taken) {
  while (count > best_first) {
    taken = pending[--count];
    if (taken.key < prune) return true;
  }
  if (count == 0) return false;
  uint32_t at = count - 1;
  for (uint32_t i = at; i-- > 0;) at = pending[i].key < pending[at].key ? i : at;
  taken = pending[at];
  pending[at] = pending[--count];
  return taken.key < prune;
}

// From the leaf at `place`, which has been read, up to the fence where that is far enough away,
// else to the root, building the next fence: the highest node with a box beside the way that is
// nearer than the fence should be. Result: false where the budget ends on the way.
template <class Bound>
inline bool climb(const View& mesh, const Bound& bound, uint32_t place, uint32_t prune,
                  uint32_t& left, Pending* pending, uint32_t& count, Search& search) {
  const Node* const nodes = mesh.nodes().data();
  const uint32_t* const parents = mesh.parents().data();
  const float leaf_m = math::square_root(search.best.distance2_m2) * (1.0f + 0x1p-22f);
  const uint32_t stop = leaf_m <= search.fence_m ? search.fence : 0;
  const float reach_m = leaf_m + search.fence_margin_m;
  const uint32_t beyond = bound.prune_key(reach_m * reach_m);
  uint32_t index = place >> 1, beside = (place & 1) ^ 1, fence = index;
  while (left != 0) {
    --left;
    const uint32_t key = bound.key(nodes[index].box[beside]);
    if (key < beyond) {
      fence = index;
      if (key < prune) pending[count++] = {key, index << 1 | beside};
    }
    if (index == stop && index != 0) return true;
    if (index == 0) {
      search.fence = fence;
      search.fence_m = reach_m * (1.0f - 0x1p-22f);
      return true;
    }
    const uint32_t word = parents[index];
    index = parent_of(word);
    beside = slot_of(word) ^ 1;
  }
  return false;
}

// One loop with its state in registers. A box is a place; a leaf that is reached is read, an inner
// node is entered by its nearer child, the other left in `pending`. A warm search begins with the
// last leaf and climbs from there to the root, leaving in `pending` what lies beside the way.
template <class Bound, class Index>
void search_nearest(const View& mesh, core::Span<const Triangle<Index>> triangles,
                    const Bound& bound_at, Vec3 p_m, uint32_t budget, uint32_t start,
                    Search& search) {
  const Bound bound = bound_at;  // in registers
  const Vertex* const vertices = mesh.vertices().data();
  const Triangle<Index>* const triangle = triangles.data();
  const Node* const nodes = mesh.nodes().data();
  const uint32_t allowed = budget == 0 ? 1 : budget;
  Pending pending[kCapacity];
  uint32_t count = 0, left = allowed;
  float least2_m2 = search.best.distance2_m2;
  uint32_t prune = bound.prune_key(least2_m2);
  bool climbing = start != query::kNowhere;
  const uint32_t best_first = climbing ? 0 : kBestFirst;
  Pending now{0, start};
  uint32_t child = climbing ? nodes[start >> 1].child[start & 1] : 0;  // else the root
  while (left != 0) {
    --left;
    if (!is_leaf(child)) {
      const Node& node = nodes[child];
      const uint32_t key0 = bound.key(node.box[0]), key1 = bound.key(node.box[1]);
      const uint32_t slot = key1 < key0 ? 1 : 0, far_key = slot ? key0 : key1;
      now.place = child << 1 | slot;
      now.key = slot ? key1 : key0;
      if (far_key < prune) pending[count++] = {far_key, now.place ^ 1u};
      if (now.key < prune) {
        child = node.child[slot];
        continue;
      }
    } else {
      const float before2_m2 = least2_m2;
      uint32_t i = leaf_first(child);
      for (const uint32_t end = i + leaf_count(child); i < end; ++i) {
        const Vertex &a = vertices[triangle[i].corner[0]], &b = vertices[triangle[i].corner[1]],
                     &c = vertices[triangle[i].corner[2]];
        const Foot foot = closest_on_triangle(p_m, {a.x_m, a.y_m, a.z_m}, {b.x_m, b.y_m, b.z_m},
                                              {c.x_m, c.y_m, c.z_m});
        if (!(foot.distance2_m2 < least2_m2)) continue;
        least2_m2 = foot.distance2_m2;
        search.best = {least2_m2, foot.offset_m, i, now.place, foot.feature};
      }
      if (least2_m2 < before2_m2) prune = bound.prune_key(least2_m2);
      if (climbing) {
        if (!climb(mesh, bound, start, prune, left, pending, count, search)) break;
        climbing = false;
      }
    }
    if (!take_next(pending, count, best_first, prune, now)) {
      search.complete = true;
      search.steps = allowed - left;
      return;
    }
    child = nodes[now.place >> 1].child[now.place & 1];
  }
  // The budget ran out: what was about to be read is left too.
  search.steps = allowed - left;
  uint32_t least = climbing ? 0 : now.key;
  for (uint32_t i = 0; i < count; ++i) least = pending[i].key < least ? pending[i].key : least;
  search.pending_m = bound.distance_m(least);
}

Vec3 feature_direction(const View& mesh, const Best& best) {
  const Triangle<uint32_t> t = mesh.triangle(best.triangle);
  const Vec3 a = mesh.vertex(t.corner[0]), b = mesh.vertex(t.corner[1]),
             c = mesh.vertex(t.corner[2]);
  const Vec3 normal = unit_normal(a, b, c);
  if (best.feature == Feature::kFace || !mesh.is_signed()) return normal;
  if (is_vertex(best.feature)) {
    const uint32_t corner =
        static_cast<uint32_t>(best.feature) - static_cast<uint32_t>(Feature::kVertex0);
    return decode_vertex_normal(mesh.vertex_normals()[t.corner[corner]]);
  }
  const uint32_t k = static_cast<uint32_t>(best.feature) - static_cast<uint32_t>(Feature::kEdge0);
  const Vec3 edge = k == 0 ? b - a : k == 1 ? c - b : a - c;
  return decode_edge_normal(normal, edge, mesh.folds()[best.triangle].fold[k]);
}

bool is_place(const View& mesh, uint32_t place) {
  return (place >> 1) < mesh.nodes().size() && is_leaf(mesh.nodes()[place >> 1].child[place & 1]);
}

template <class Bound>
Closest answer(const View& mesh, const Bound& bound, Vec3 p_m, query::Budget budget,
               query::Hint& hint) {
  const query::Carried carried = query::carry(hint, p_m);
  Search search;
  uint32_t start = hint.place;
  if (!is_place(mesh, start)) {  // cold: a stored vertex is a point of the surface before any
                                 // triangle is reached
    start = query::kNowhere;
    search.best.offset_m = p_m - mesh.vertex(mesh.triangle(0).corner[0]);
    search.best.distance2_m2 = dot(search.best.offset_m, search.best.offset_m);
  }
  search.fence = hint.fence;
  search.fence_m = carried.fence_m;
  search.fence_margin_m = kFenceMotions * carried.motion_m;
  if (!mesh.triangles16().empty())
    search_nearest(mesh, mesh.triangles16(), bound, p_m, budget.steps, start, search);
  else
    search_nearest(mesh, mesh.triangles32(), bound, p_m, budget.steps, start, search);
  const Best& best = search.best;

  Closest closest;
  const float distance_m = math::square_root(best.distance2_m2);
  const float scale_m = distance_m > mesh.head().diagonal_m ? distance_m : mesh.head().diagonal_m;
  float lower_m = distance_m - kDistanceError * scale_m;
  if (!search.complete && search.pending_m < lower_m) lower_m = search.pending_m;
  if (!(lower_m > 0.0f)) lower_m = 0.0f;
  // The carried bound is worth keeping where the search was cut short; after a complete one it can
  // only be older.
  if (!search.complete && carried.lower_m > lower_m) lower_m = carried.lower_m;

  closest.point_m = bound.foot_m(mesh, p_m, best.offset_m, best.triangle);
  closest.direction = feature_direction(mesh, best);
  closest.triangle = best.triangle;
  closest.feature = best.feature;
  closest.certificate.lower_m = lower_m;
  closest.certificate.steps = search.steps;
  closest.certificate.exact = search.complete;
  if (mesh.is_signed()) {
    const int8_t side = dot(best.offset_m, closest.direction) >= 0.0f ? 1 : -1;
    closest.certificate.sign = bound.is_outside() ? 1 : search.complete ? side : carried.sign;
  }
  closest.distance_m = closest.certificate.sign < 0 ? -distance_m : distance_m;

  if (best.place != query::kNowhere) hint.place = best.place;
  hint.position_m = p_m;
  hint.lower_m = lower_m;
  hint.sign = closest.certificate.sign;
  hint.fence = search.fence;
  hint.fence_m = search.fence_m;
  return closest;
}

// So far away that every vertex is as near as any other to 1e-9: no square of such a distance fits
// a float.
Closest answer_beyond(const View& mesh, Vec3 p_m, query::Hint& hint) {
  Closest closest;
  closest.point_m = mesh.vertex(mesh.triangle(0).corner[0]);
  closest.direction = unit(Vec3{p_m.x * 0x1p-100f, p_m.y * 0x1p-100f, p_m.z * 0x1p-100f});
  closest.feature = Feature::kVertex0;
  closest.certificate.steps = 1;
  const float scaled = math::length((p_m - closest.point_m) * 0x1p-70f);
  const bool fits = scaled < 0x1p57f;
  closest.distance_m = fits ? scaled * 0x1p70f : FLT_MAX;
  closest.certificate.lower_m = closest.distance_m * (1.0f - kDistanceError);
  closest.certificate.exact = fits;
  closest.certificate.sign = mesh.is_signed() ? 1 : 0;
  hint.position_m = p_m;
  hint.lower_m = closest.certificate.lower_m;
  hint.sign = closest.certificate.sign;
  hint.fence = query::kNowhere;
  return closest;
}

Closest answer_nothing(const View& mesh, query::Hint& hint) {
  Closest closest;
  closest.point_m = mesh.vertex(mesh.triangle(0).corner[0]);
  closest.direction = {0, 0, 1};
  closest.distance_m = FLT_MAX;
  closest.feature = Feature::kVertex0;
  hint.lower_m = 0;
  hint.sign = 0;
  hint.fence = query::kNowhere;
  return closest;
}

}  // namespace

Closest closest_point(const View& mesh, Vec3 p_m, query::Budget budget, query::Hint& hint) {
  if (!math::is_finite(p_m)) return answer_nothing(mesh, hint);
  NearBound near_bound;
  if (near_bound.begin(mesh.head(), p_m)) return answer(mesh, near_bound, p_m, budget, hint);
  if (!(math::dot(p_m * (1.0f / kBeyond_m), p_m * (1.0f / kBeyond_m)) <= 1.0f))
    return answer_beyond(mesh, p_m, hint);
  FarBound far_bound;
  far_bound.begin(mesh.head(), p_m);
  return answer(mesh, far_bound, p_m, budget, hint);
}

uint64_t probe_hash(const View& mesh, core::Span<const query::ProbePoint> points) {
  core::Hash hash;
  query::Hint hint;
  for (const query::ProbePoint& p : points) {
    const Closest c = closest_point(mesh, {p.x_m, p.y_m, p.z_m}, query::kUnlimited, hint);
    const float values[] = {c.distance_m,  c.point_m.x,   c.point_m.y,   c.point_m.z,
                            c.direction.x, c.direction.y, c.direction.z, c.certificate.lower_m};
    for (const float value : values) hash.add(math::bits_of(value));
    hash.add(c.triangle);
    hash.add(static_cast<uint32_t>(c.feature));
    hash.add(c.certificate.steps);
  }
  return hash.value();
}

}  // namespace firmtouch::mesh
