#pragma once
// The search for the nearest triangle: the module's inner loop. For closest_point.cpp alone.

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/compensated_distance.hpp"
#include "firmtouch/mesh/grid.hpp"
#include "firmtouch/mesh/hint.hpp"
#include "firmtouch/mesh/leaf.hpp"
#include "firmtouch/mesh/loss.hpp"
#include "firmtouch/mesh/pending.hpp"
#include "firmtouch/mesh/view.hpp"

namespace firmtouch::mesh {
namespace {

using math::Vec3;

/// Input and result of a search.
struct Search : Sought {
  uint32_t start;               // a leaf's slot, or kNowhere
  uint32_t budget;              // in parts of work units
  float band2_m2;               // triangles farther away need not be found
  float safe_subtree_margin_m;  // margin of a new safe subtree beyond the first leaf
  uint32_t safe_subtree;        // in: the last one; all triangles outside it are at least ...
  float safe_subtree_m;         // ... this far away; out: the same, renewed
  uint32_t parts;               // taken of the budget
  uint32_t charged;             // of these, beyond the visits
  float pending_m;              // if not complete: certified distance to all that was not visited
  math::HalfCellPoint half_cells;  // of p_m; for the boxes of leaves alone
  const uint32_t* leaf_boxes;

  void begin_rivals(const View& mesh) {
    rivals.clear();
    rivals.slack_m2 = Rivals::slack_of(mesh.head().longest_edge_m);
    rivals.owed = 0;
    rivals.mesh = &mesh;
  }
};

template <bool kFirst, class First, class Second>
struct Choice {
  using Type = First;
};
template <class First, class Second>
struct Choice<false, First, Second> {
  using Type = Second;
};

constexpr uint32_t parts_of(uint32_t units) {
  if (units > UINT32_MAX / kPartsOfUnit) return UINT32_MAX;
  return units <= kBeginUnits ? 1 : (units - kBeginUnits) * kPartsOfUnit;
}
// Units that a search took, at most those allowed.
inline uint32_t units_of(uint32_t parts, uint32_t allowed) {
  const uint32_t units = kBeginUnits + (parts + kPartsOfUnit - 1) / kPartsOfUnit;
  return units < allowed ? units : allowed;
}

// Instead of an index type: indices of 16 bits, and each leaf has an oriented box, which is tested
// before its triangles.
struct Boxed {};
// Instead of an index type: a mesh that has rivals (View::has_rivals()), or indices of 32 bits,
// with oriented boxes or without.
struct WithRivals {};
template <class Kind>
constexpr bool kIsBoxed = false;
template <>
constexpr bool kIsBoxed<Boxed> = true;

template <class Kind>
constexpr bool kHasRivals = false;
template <>
constexpr bool kHasRivals<WithRivals> = true;

// Takes parts beyond a visit. The visit itself is still to be taken: one is left.
[[gnu::always_inline]] inline void charge(uint32_t parts, uint32_t& left, Search& search) {
  const uint32_t taken = parts < left ? parts : left - 1;
  left -= taken;
  search.charged += taken;
}

template <bool kCompensated, class Index>
[[gnu::always_inline]] inline void charge_leaf(uint32_t child, uint32_t& left, Search& search) {
  uint32_t parts = (kCompensated ? kCompensatedParts : kTriangleParts) * leaf_count(child);
  if constexpr (kHasRivals<Index>) {
    parts += search.rivals.owed;
    search.rivals.owed = 0;
  }
  charge(parts, left, search);
}

// The cutoff by the nearest so far, or by the band. A square is never -0, so a band of 0 works.
template <class Bound>
inline uint32_t prune_key(const Bound& bound, const Search& search) {
  return bound.prune_key(math::smaller(search.best.distance2_m2, search.band2_m2));
}

// From the leaf at search.start, which has been visited, up to the safe subtree if its certificate
// is still far enough, else to the root. Pushes sibling boxes that are near. The next safe subtree
// is the highest node on the path with a sibling nearer than the margin. Result: false if the
// budget ends.
template <class Bound>
inline bool ascend(const View& mesh, const Side* sides, const Bound& bound, uint32_t prune,
                   uint32_t& left, Pending*& top, Search& search) {
  const uint32_t* const parents = mesh.parents().data();
  const float leaf_m = math::square_root(math::smaller(search.best.distance2_m2, search.band2_m2)) *
                       (1.0f + 0x1p-22f);
  const float reach_m = leaf_m + search.safe_subtree_margin_m;
  const uint32_t beyond = bound.prune_key(reach_m * reach_m);
  uint32_t slot = search.start;
  uint32_t stop = leaf_m <= search.safe_subtree_m ? search.safe_subtree : 0,
           safe_subtree = slot >> 1;
  for (; left != 0; --left) {
    const uint32_t beside = slot ^ 1u, index = slot >> 1;
    const uint32_t key = bound.key(sides[beside].box);
    if (key < beyond) {
      safe_subtree = index;
      if (key < prune) push(top, key, beside);
    }
    // Parents come before their children: at the safe subtree, or past one that is no ancestor.
    if (index <= stop) {
      if (index == 0) {
        search.safe_subtree = safe_subtree;
        search.safe_subtree_m = reach_m * (1.0f - 0x1p-22f);
      }
      if (index == 0 || index == stop) {
        --left;
        return true;
      }
      stop = 0;
    }
    slot = slot_of(parents[index]);
  }
  return false;
}

template <class Index>
inline core::Span<const Triangle<Index>> triangles_of(const View& mesh) {
  if constexpr (sizeof(Index) == sizeof(uint16_t))
    return mesh.triangles16();
  else
    return mesh.triangles32();
}

// Pointers to the mesh for measure().
template <class Index, class Bound>
inline void begin_leaves(const View& mesh, [[maybe_unused]] const Bound& bound, Search& search) {
  if constexpr (kIsBoxed<Index> || kHasRivals<Index>) {
    search.half_cells = bound.half_cells();
    search.leaf_boxes = mesh.leaf_boxes();
    search.vertices = mesh.vertices().data();
    search.is_narrow = !mesh.triangles16().empty();
    search.triangles = search.is_narrow ? static_cast<const void*>(mesh.triangles16().data())
                                        : mesh.triangles32().data();
    search.begin_rivals(mesh);
  } else {
    search.vertices = mesh.vertices().data();
    search.triangles = triangles_of<Index>(mesh).data();
  }
}

// Which leaf: that of the last answer, or another one.
enum class Which { kLast, kBeside };

// Functions of their own: inlined they take the registers of the descent.
// Result: 0 where a triangle was nearer. A search measures no leaf twice.
//
// Triangles that may be the nearest are measured again in double-float.
[[gnu::noinline, gnu::cold]] uint32_t measure_compensated(const View& mesh, uint32_t child,
                                                          uint32_t slot, Search& search) {
  const Loss loss(mesh.head());
  const Vec3 p_m{search.p_m.x, search.p_m.y, search.p_m.z};
  Best& best = search.best;
  float min2_m2 = best.distance2_m2;
  const uint32_t first = leaf_first(child), end = first + leaf_count(child);
  for (uint32_t i = first; i != end; ++i) {
    const Triangle<uint32_t> triangle = mesh.triangle(i);
    const Vec3 a_m = mesh.vertex(triangle.corner[0]), b_m = mesh.vertex(triangle.corner[1]),
               c_m = mesh.vertex(triangle.corner[2]);
    Foot foot;
    if (!find_foot_apart(p_m, {a_m, b_m, c_m}, Nearer::than(min2_m2, search.slack_m2), foot) ||
        !loss.may_be_less(foot.distance2_m2, min2_m2))
      continue;
    foot.distance2_m2 = nearest_compensated2(p_m, a_m, b_m, c_m, foot.feature, foot.distance2_m2);
    if (!(foot.distance2_m2 < min2_m2)) continue;
    min2_m2 = foot.distance2_m2;
    best.distance2_m2 = min2_m2;  // one by one: an aggregate is built on the stack first
    best.offset_m = foot.offset_m;
    best.triangle = i;
    best.slot = slot;
    best.feature = foot.feature;
  }
  return best.slot ^ slot;
}
// `prune`, which it does not need, is in the register in which measure_boxed() has it.
template <class Wanted>
[[gnu::noinline]] uint32_t measure_plain([[maybe_unused]] uint32_t prune, uint32_t child,
                                         uint32_t slot, Search& search) {
  measure_triangles<LeafCorners<uint16_t>, Wanted>(child, slot, search);
  return search.best.slot ^ slot;
}
// Whether the box of a leaf excludes all of its triangles.
[[gnu::always_inline]] inline bool is_beyond(uint32_t prune, uint32_t child, const Search& search) {
  const uint32_t* const box = search.leaf_boxes + size_t{kLeafBoxStride} * leaf_first(child);
  return math::oriented_distance2(box, search.half_cells) >= prune;
}
// 32 bits are rare on a controller.
[[gnu::noinline, gnu::cold]] void measure_wide_rivals(uint32_t child, uint32_t slot,
                                                      Search& search) {
  measure_rivals<LeafTriangles, true>(child, slot, search);
}
[[gnu::noinline]] uint32_t measure_with_rivals(uint32_t prune, uint32_t child, uint32_t slot,
                                               Search& search) {
  if (search.leaf_boxes != nullptr && prune != 0 && is_beyond(prune, child, search)) return 1;
  if (search.is_narrow)
    measure_rivals<LeafCorners<uint16_t>, false>(child, slot, search);
  else
    measure_wide_rivals(child, slot, search);
  return search.best.slot ^ slot;
}
[[gnu::noinline]] uint32_t measure_boxed(uint32_t prune, uint32_t child, uint32_t slot,
                                         Search& search) {
  if (prune != 0 && is_beyond(prune, child, search)) return 1;
  return measure_plain<Nearer>(prune, child, slot, search);
}

// `prune`: the lowest key that is not visited; 0 at the last leaf. Result: whether a triangle was
// nearer. A compensated search tests the index width at each triangle, which costs nothing there
// and saves 2 to 3 kB.
template <bool kCompensated, class Index, Which kWhich>
inline bool measure(const View& mesh, [[maybe_unused]] uint32_t prune, uint32_t child,
                    uint32_t slot, Search& search) {
  // Before the last leaf there is no bound that could exclude a triangle.
  using Wanted = typename Choice<kWhich == Which::kLast, Everything, Nearer>::Type;
  if constexpr (kCompensated) {
    return measure_compensated(mesh, child, slot, search) == 0;
  } else if constexpr (kHasRivals<Index>) {
    return measure_with_rivals(prune, child, slot, search) == 0;
  } else if constexpr (kIsBoxed<Index>) {
    return measure_boxed(prune, child, slot, search) == 0;
  } else {
    return measure_plain<Wanted>(prune, child, slot, search) == 0;
  }
}

// Descends to the nearer box below `prune` of an inner node; pushes the other one if it is below
// too.
// Result: false if neither is below.
template <class Bound>
[[gnu::always_inline]] inline bool enter(const Side* sides, const Bound& bound, uint32_t prune,
                                         uint32_t& child, uint32_t& slot, Pending*& top) {
  slot = 2 * child;
  uint32_t key0, key1, child0, child1;
  bound.keys(sides + slot, key0, key1, child0, child1);
  if (key0 < prune) {
    if (key1 < prune) {
      if (key1 < key0) {
        push(top, key0, slot);
        slot |= 1u;
        child = child1;
        return true;
      }
      push(top, key1, slot | 1u);
    }
    child = child0;
    return true;
  }
  if (key1 >= prune) return false;
  slot |= 1u;
  child = child1;
  return true;
}

// One loop with its state in registers. It measures leaves and descends inner nodes to the nearer
// child; the other child goes to `pending`. A warm search begins at the last leaf and ascends
// first, pushing the sibling boxes. noinline: with its caller's values the loop's do not stay in
// registers. `Index`: of the triangles; void if compensated.
template <bool kCompensated, class Bound, class Index>
[[gnu::noinline]] bool search_nearest(const View& mesh, const Bound& bound_at, Search& search) {
  const Bound bound = bound_at;  // in registers
  const Side* const sides = mesh.sides();
  const uint32_t allowed = search.budget;
  Pending pending[kCapacity];
  Pending* top = pending;  // behind the last
  const Pending* best_first = pending;
  uint32_t left = allowed, slot = query::kNowhere, child = 0, prune;
  if constexpr (!kCompensated) begin_leaves<Index>(mesh, bound, search);
  if (search.start != query::kNowhere) {
    const uint32_t last = sides[search.start].child;
    search.charged = 0;
    charge_leaf<kCompensated, Index>(last, left, search);
    --left;
    measure<kCompensated, Index, Which::kLast>(mesh, 0, last, search.start, search);
    prune = prune_key(bound, search);
    if (!ascend(mesh, mesh.sides(), bound, prune, left, top, search)) {
      search.parts = allowed;
      search.pending_m = 0.0f;
      return false;
    }
    if (!take_last(top, best_first, prune, slot)) {
      search.parts = allowed - left;
      return true;
    }
    child = sides[slot].child;
  } else {
    search.charged = 0;
    prune = prune_key(bound, search);
    // Without a budget no lower bound is needed on the way.
    if (allowed != UINT32_MAX) best_first += kBestFirst;
  }
  for (bool is_left = left != 0; is_left; is_left = math::count_down(left)) {
    if (!is_leaf(child)) {
      if constexpr (Bound::kVisitParts > 1) charge(Bound::kVisitParts - 1, left, search);
      if (enter(sides, bound, prune, child, slot, top)) continue;
    } else {
      charge_leaf<kCompensated, Index>(child, left, search);
      if (measure<kCompensated, Index, Which::kBeside>(mesh, prune, child, slot, search))
        prune = prune_key(bound, search);
    }
    // Many pending, or warm: last in first out, where the order does not matter and costs nothing.
    if (!take_last(top, best_first, prune, slot)) {
      const uint32_t count = static_cast<uint32_t>(top - pending);
      Taken taken{0, 0, left - 1, false};
      if (count != 0)
        taken = take_smallest(sides, bound_at, pending, count, prune, left - 1, search.charged);
      if (!taken.found) {
        search.parts = allowed - taken.left;
        return true;
      }
      slot = taken.slot;
      top = pending + taken.count;
      left = taken.left + 1;
    }
    child = sides[slot].child;
  }
  // The budget ran out before the next box, which counts as pending too.
  search.parts = allowed;
  uint32_t least = bound.key(sides[slot].box);
  for (const Pending* p = pending; p != top; ++p) least = p->key < least ? p->key : least;
  search.pending_m = bound.distance_m(least);
  return false;
}

}  // namespace
}  // namespace firmtouch::mesh
