#pragma once
#include <stdint.h>

#include "firmtouch/hull/view.hpp"
#include "firmtouch/mesh/segment_cast.hpp"

namespace firmtouch::hull {

/// A crossing that a refinement has found and may have to refine.
struct Candidate {
  float t;
  uint32_t
      what;  // a triangle of the mesh, or the collapse that made the face (nearest_candidates.hpp)
};

/// The memory of a refinement, the caller's.
struct RefinementMemory {
  // One bit a collapse (hull::bit_words() words): set while it is split back; clear between
  // queries.
  core::Span<uint32_t> is_split;
  // Collapses that are split back, in order: queue of the closure, queue of the stars to test, and
  // list to reset. One a collapse always suffices; with fewer the answer may be conservative.
  core::Span<uint32_t> splits;
  // Pending crossings; at most 40 were seen. If they run out, the answer is conservative.
  core::Span<Candidate> candidates;
};

constexpr uint32_t bit_words(uint32_t collapses) { return collapses / 32 + 1; }

struct RefinedHit {
  bool hit = false;
  bool exact = false;       // of the mesh, and the first; or certainly none
  bool is_of_mesh = false;  // else the crossing of a hull: none of the mesh is nearer
  float t = 1;
  uint32_t triangle = 0;  // in leaf order, where is_of_mesh
  bool enters = false;
  uint32_t steps = 0;   // visits: boxes and stars read
  uint32_t splits = 0;  // collapses split back
  uint32_t tests = 0;   // of a face
};

struct RefinedCrossings {
  uint32_t found = 0, reported = 0;  // as mesh::Crossings
  uint32_t steps = 0, splits = 0, tests = 0;
  bool exact = false;  // false: budget or memory ran out; there may be more
};

/// Selective refinement of a progressive hull along a segment or triangle: where it crosses a face,
/// the collapse that made the face is split back, until it crosses only triangles of the mesh. The
/// only state is one bit a collapse.
///
/// A face is made by the collapse of its youngest vertex and replaced by the first collapse that
/// removes one of its vertices. It exists if the former is not split back and the latter is, or
/// comes after the base hull. A split needs the new vertex and its link, so the collapses that
/// removed those are split back first: the closure. A closure that exceeds the memory is taken back
/// as a whole.
///
/// Result: for a segment that begins outside the base hull, the first crossing is the mesh's; of
/// all
///         crossings the first and the last are found. Others, and those of a segment that begins
///         between hull and mesh, may be missed (hull/complete_cast.hpp finds all). If budget or
///         memory runs out, no crossing of the mesh is nearer than the reported one (from outside).
/// Source: Platis & Theoharis 2003, section 3.2; of the corners of a face that is crossed it splits
/// the one that made it, where the paper splits each that it can.
class Refinement {
 public:
  /// Pre: `base_hull` was opened against `hull`; memory.is_split holds bit_words(collapse_count()),
  /// the
  ///      others at least one each. All outlive this.
  Refinement(const View& hull, const BaseHull& base_hull, const RefinementMemory& memory);

  /// First crossing of the segment from `a_m` to `b_m` (mesh frame), either way.
  /// Bounds: <= budget visits plus the closure of the last; 5 KB of stack; not re-entrant.
  /// Result: least t; equal t: the lowest triangle in leaf order.
  RefinedHit first(math::Vec3 a_m, math::Vec3 b_m, query::Budget budget);

  /// A crossing of the mesh, the nearest that turns up first.
  RefinedHit any(math::Vec3 a_m, math::Vec3 b_m, query::Budget budget);

  /// Every crossing that the refinement finds, in order of t.
  RefinedCrossings all(math::Vec3 a_m, math::Vec3 b_m, query::Budget budget,
                       core::Span<mesh::SurfaceCrossing> buffer);

  /// The same for a triangle: crossings have t = 0 and no direction. A triangle with a corner
  /// outside the base hull that crosses none of its faces does not meet the mesh. One that crosses
  /// the mesh only inside the hull may be missed (hull/triangle_cast.hpp finds all).
  RefinedHit any(const math::Vec3 (&corner_m)[3], query::Budget budget);
  RefinedCrossings all(const math::Vec3 (&corner_m)[3], query::Budget budget,
                       core::Span<mesh::SurfaceCrossing> buffer);

  /// Splits one collapse and its closure back until reset() or the next query: a locally finer
  /// hull. Result: false if the memory does not suffice; then nothing has changed.
  bool split(uint32_t collapse);
  /// Back to the base hull.
  void reset();
  /// The collapses that are split back now, in order.
  core::Span<const uint32_t> splits() const { return {memory_.splits.data(), count_}; }
  bool is_split(uint32_t collapse) const {
    return (memory_.is_split[collapse / 32] >> (collapse % 32) & 1u) != 0;
  }

 private:
  template <class Shape>
  class Search;
  bool add(uint32_t collapse);
  template <class Shape>
  RefinedHit nearest(const Shape& shape, query::Budget budget, bool is_any);
  template <class Shape>
  RefinedCrossings every(const Shape& shape, query::Budget budget,
                         core::Span<mesh::SurfaceCrossing> buffer);

  const View& hull_;
  const BaseHull& base_hull_;
  RefinementMemory memory_;
  uint32_t count_ = 0;
};

}  // namespace firmtouch::hull
