#include "firmtouch/mesh/segment_cast.hpp"

#include "firmtouch/math/isa_segment.hpp"
#include "firmtouch/mesh/crossing_takers.hpp"
#include "firmtouch/mesh/segment_frame.hpp"

namespace firmtouch::mesh {
namespace {

using math::Vec3;

/// The segment in cells of the mesh's grid.
///
/// With u = 2^-24 and o the origin in cells: o is off by u |o|, the box check by 2^-9 cells, rate and
/// each plane's difference by 3 u of the plane's distance, at most |o| + 32768: 4 u |o| + 2^-7 in
/// all. Slabs widen boxes by twice that.
math::GridSegment on_grid(const Head& head, Vec3 a_m, Vec3 b_m) {
  const float per_cell = 1.0f / head.cell_m;
  return {{(a_m.x - head.grid_low_m[0]) * per_cell, (a_m.y - head.grid_low_m[1]) * per_cell,
           (a_m.z - head.grid_low_m[2]) * per_cell},
          {(b_m.x - a_m.x) * per_cell, (b_m.y - a_m.y) * per_cell, (b_m.z - a_m.z) * per_cell}};
}

// What is still to be visited: the bits of the entry, which order as the entry does, above the
// child. The greatest stands below all others and ends the search.
using Pending = uint64_t;
constexpr Pending kEnd = UINT64_MAX;
constexpr uint32_t child_of(Pending pending) { return static_cast<uint32_t>(pending); }
constexpr uint32_t key_of(Pending pending) { return static_cast<uint32_t>(pending >> 32); }
constexpr Pending pending_of(uint32_t key, uint32_t child) { return Pending{key} << 32 | child; }

template <class Visitor>
bool take_leaf(const View& mesh, const SegmentFrame& frame, uint32_t leaf, Visitor& visitor) {
  const uint32_t first = leaf_first(leaf), end = first + leaf_count(leaf);
  for (uint32_t i = first; i < end; ++i) {
    const Triangle<uint32_t> t = mesh.triangle(i);
    const Crossing crossing = frame.crossing(mesh.vertex(t.corner[0]), mesh.vertex(t.corner[1]),
                                             mesh.vertex(t.corner[2]));
    if (crossing.direction != 0 && !visitor.take(crossing, i)) return false;
  }
  return true;
}

/// Visits what the segment may cross, nearest first, until `visitor` has enough. Visitor::limit is
/// the largest t that is still of interest, Visitor::take() answers whether it wants more.
/// Result: whether the search came to its end.
template <class Visitor>
bool search(const View& mesh, Vec3 a_m, Vec3 b_m, query::Budget budget, Visitor& visitor,
            uint32_t& steps) {
  math::Slabs slabs;
  if (!slabs.begin(on_grid(mesh.head(), a_m, b_m)) &&
      !(math::is_finite(a_m) && math::is_finite(b_m)))
    return false;
  slabs.set_limit(visitor.limit);
  uint32_t last_key = math::bits_of(visitor.limit);
  const uint32_t allowed = budget.steps == 0 ? 1 : budget.steps;
  SegmentFrame frame;
  bool has_frame = false;  // many segments reach no leaf
  const Node* nodes = mesh.nodes().data();
  Pending pending[kMaxDepth + 2];
  uint32_t count = 1;
  pending[0] = kEnd;
  Pending now = pending_of(0, 0);
  while (true) {
    if (key_of(now) > last_key) {
      if (now == kEnd) return true;
      now = pending[--count];
      continue;
    }
    if (steps == allowed) return false;
    ++steps;
    if (is_leaf(child_of(now))) {
      if (!has_frame) frame = SegmentFrame(mesh.head(), a_m, b_m);
      has_frame = true;
      if (!take_leaf(mesh, frame, child_of(now), visitor)) return true;
      if (math::bits_of(visitor.limit) != last_key) slabs.set_limit(visitor.limit);
      last_key = math::bits_of(visitor.limit);
      now = pending[--count];
      continue;
    }
    // Without branches, which could not be foretold: the nearer of what is entered is next, else
    // what was left last.
    const Node& node = nodes[child_of(now)];
    uint32_t key[2];
    slabs.enter(reinterpret_cast<const uint32_t*>(&node), key);
    const Pending one = pending_of(key[0], node.side[0].child),
                  other = pending_of(key[1], node.side[1].child);
    const Pending nearer = one < other ? one : other, farther = one < other ? other : one;
    const Pending left = pending[count - 1];
    const bool any = key_of(nearer) != math::kNotEntered;
    pending[count] = farther;
    count += key_of(farther) != math::kNotEntered ? 1u : 0u;
    count -= any ? 0u : 1u;
    now = any ? nearer : left;
  }
}

}  // namespace

Hit cast_segment(const View& mesh, Vec3 a_m, Vec3 b_m, query::Budget budget) {
  First first;
  first.hit.exact = search(mesh, a_m, b_m, budget, first, first.hit.steps);
  return first.hit;
}

Hit any_crossing(const View& mesh, Vec3 a_m, Vec3 b_m, query::Budget budget) {
  Any any;
  any.hit.exact = search(mesh, a_m, b_m, budget, any, any.hit.steps);
  return any.hit;
}

Crossings all_crossings(const View& mesh, Vec3 a_m, Vec3 b_m, query::Budget budget,
                        core::Span<SurfaceCrossing> room) {
  All all(room);
  all.crossings.exact = search(mesh, a_m, b_m, budget, all, all.crossings.steps);
  return all.crossings;
}

}  // namespace firmtouch::mesh
