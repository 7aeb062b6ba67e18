#include "firmtouch/mesh/segment_cast.hpp"

#include "firmtouch/math/isa_segment.hpp"
#include "firmtouch/mesh/segment_frame.hpp"

namespace firmtouch::mesh {
namespace {

using math::Vec3;

/// The segment in cells of the mesh's grid, widened so that no box is entered later, or left
/// earlier, than in truth.
///
/// With u = 2^-24 and o the origin in cells: o is off by u |o|, the box check by 2^-9 cells, rate and
/// each plane's difference by 3 u of the plane's distance, at most |o| + 32768: 4 u |o| + 2^-7 in
/// all. Twice that is taken. An axis along which the segment stands still has a rate so high that
/// it is inside the slab, or is not, for the whole segment. An end too far off for this arithmetic
/// enters every box.
math::SegmentSlabs slabs_of(const Head& head, Vec3 a_m, Vec3 along_m) {
  constexpr float kStill = 1e-30f, kFar = 0x1p60f;
  const float at[3] = {a_m.x, a_m.y, a_m.z}, along[3] = {along_m.x, along_m.y, along_m.z};
  const float per_cell = 1.0f / head.cell_m;
  math::SegmentSlabs slabs;
  bool is_far = false;
  for (uint32_t k = 0; k < 3; ++k) {
    const float origin = (at[k] - head.grid_low_m[k]) * per_cell, step = along[k] * per_cell;
    is_far |= !(absolute(origin) <= kFar && absolute(step) <= kFar);
    const float slack = absolute(origin) * 0x1p-21f + 0x1p-6f;
    const float low = origin + slack, high = static_cast<float>(kGridMax) - (origin - slack);
    slabs.turn[k] = step < 0.0f ? 16u : 0u;
    slabs.enter[k] = step < 0.0f ? high : low;
    slabs.leave[k] = step < 0.0f ? low : high;
    slabs.rate[k] = 1.0f / larger(absolute(step), kStill);
  }
  for (uint32_t k = 0; k < 3 && is_far; ++k) {
    slabs.enter[k] = slabs.leave[k] = 32768.0f;
    slabs.rate[k] = 1.0f;
  }
  return slabs;
}

struct Pending {
  float entry;
  uint32_t child;
};

/// Visits what the segment may cross, nearest first, until `visitor` has enough. Visitor::limit is
/// the largest t that is still of interest, Visitor::take() answers whether it wants more.
/// Result: whether the search came to its end.
template <class Visitor>
bool search(const View& mesh, Vec3 a_m, Vec3 b_m, query::Budget budget, Visitor& visitor,
            uint32_t& steps) {
  if (!math::is_finite(a_m) || !math::is_finite(b_m)) return false;
  const SegmentFrame frame(mesh.head(), a_m, b_m);
  math::SlabLanes slabs(slabs_of(mesh.head(), a_m, b_m - a_m));
  slabs.set_limit(visitor.limit);
  const uint32_t allowed = budget.steps == 0 ? 1 : budget.steps;
  const Node* nodes = mesh.nodes().data();
  Pending pending[kMaxDepth + 2];
  uint32_t count = 1;
  pending[0] = {0.0f, 0};
  while (count > 0) {
    const Pending now = pending[--count];
    if (now.entry > visitor.limit) continue;
    if (steps == allowed) return false;
    ++steps;
    if (is_leaf(now.child)) {
      const uint32_t first = leaf_first(now.child), end = first + leaf_count(now.child);
      for (uint32_t i = first; i < end; ++i) {
        const Triangle<uint32_t> t = mesh.triangle(i);
        const Crossing crossing = frame.crossing(mesh.vertex(t.corner[0]), mesh.vertex(t.corner[1]),
                                                 mesh.vertex(t.corner[2]));
        if (crossing.direction != 0 && !visitor.take(crossing, i)) return true;
      }
      slabs.set_limit(visitor.limit);
      continue;
    }
    const Node& node = nodes[now.child];
    float entry[2];
    const uint32_t entered = slabs.entered(node.side[0].box, entry);
    // Both are written; how many of them count is what was entered.
    const uint32_t nearer = entered == 2 || (entered == 3 && entry[1] < entry[0]) ? 1 : 0;
    pending[count] = {entry[nearer ^ 1], node.side[nearer ^ 1].child};
    count += entered == 3 ? 1 : 0;
    pending[count] = {entry[nearer], node.side[nearer].child};
    count += entered != 0 ? 1 : 0;
  }
  return true;
}

class First {
 public:
  float limit = 1;
  Hit hit;

  bool take(const Crossing& crossing, uint32_t triangle) {
    const bool is_first =
        !hit.hit || crossing.t < hit.t || (crossing.t <= hit.t && triangle < hit.triangle);
    if (!is_first) return true;
    hit.hit = true;
    hit.t = crossing.t;
    hit.triangle = triangle;
    hit.enters = crossing.direction < 0;
    // A box that is entered later in truth may hold a crossing that is told earlier.
    limit = smaller(crossing.t + 2.0f * kTimeError, 1.0f);
    return true;
  }
};

class Any {
 public:
  float limit = 1;
  Hit hit;

  bool take(const Crossing& crossing, uint32_t triangle) {
    hit.hit = true;
    hit.t = crossing.t;
    hit.triangle = triangle;
    hit.enters = crossing.direction < 0;
    return false;
  }
};

class All {
 public:
  explicit All(core::Span<SurfaceCrossing> room) : room_(room) {}
  float limit = 1;
  Crossings crossings;

  bool take(const Crossing& crossing, uint32_t triangle) {
    ++crossings.found;
    uint32_t at = crossings.told;
    if (at < room_.size()) {
      ++crossings.told;
    } else if (at == 0 || !is_before(crossing.t, triangle, room_[at - 1])) {
      return true;
    } else {
      --at;  // the last one gives way
    }
    for (; at > 0 && is_before(crossing.t, triangle, room_[at - 1]); --at)
      room_[at] = room_[at - 1];
    room_[at] = {crossing.t, triangle, crossing.direction < 0};
    return true;
  }

 private:
  static bool is_before(float t, uint32_t triangle, const SurfaceCrossing& other) {
    return t < other.t || (t <= other.t && triangle < other.triangle);
  }
  core::Span<SurfaceCrossing> room_;
};

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
