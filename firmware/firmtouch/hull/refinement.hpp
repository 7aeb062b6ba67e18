#pragma once
#include <stdint.h>

#include "firmtouch/hull/view.hpp"
#include "firmtouch/mesh/segment_cast.hpp"

namespace firmtouch::hull {

/// A crossing that a refinement has found, or has yet to look at.
struct Candidate {
  float t;
  uint32_t
      what;  // a triangle of the mesh, or the collapse that made the face (nearest_candidates.hpp)
};

/// The memory of a refinement, the caller's.
struct RefinementMemory {
  // One bit a collapse (hull::bit_words() of them): the hull between two queries has none undone.
  core::Span<uint32_t> is_split;
  // What is undone: queue of the closure, queue of what is to be tested, and list of what is to be
  // done again, in one. As many as collapses never run out; where they do, the answer is
  // conservative.
  core::Span<uint32_t> splits;
  // Crossings in order of t; 40 were the most seen. Where they run out, the answer is conservative.
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
  uint32_t steps = 0;   // boxes and stars looked at
  uint32_t splits = 0;  // collapses undone
  uint32_t tests = 0;   // of a face
};

struct RefinedCrossings {
  uint32_t found = 0, reported = 0;  // as mesh::Crossings
  uint32_t steps = 0, splits = 0, tests = 0;
  bool exact = false;  // false: budget or memory ran out; there may be more
};

/// Selective refinement of a progressive hull by segments: where one crosses the hull, the collapse
/// that made the face is undone, until only triangles of the mesh are crossed. Nothing is mutated
/// but one bit a collapse.
///
/// A face was made by the collapse of its youngest vertex and is replaced by the first collapse that
/// removes a vertex of it. It is there if the one is not undone, and the other is (or comes after the
/// shell's). To undo a collapse, its new vertex and its link must be there, so the collapses that
/// removed them are undone first: the closure. If that does not fit the memory, it is taken back: half
/// of one would be no hull.
///
/// Result: for segments that begin outside the shell the first crossing is the mesh's, and of all
///         crossings the first and the last. Those between, and those of a segment that begins between
///         hull and mesh, may be missed: hull/complete_cast.hpp misses none. With a budget or memory
///         that runs out: no crossing of the mesh is nearer than what is told (from outside).
/// Source: Platis & Theoharis 2003, section 3.2.
class Refinement {
 public:
  /// Pre: `shell` was opened against `hull`; memory.is_split holds bit_words(collapse_count()), the
  ///      others at least one each. Hull, shell and memory outlive this.
  Refinement(const View& hull, const BaseHull& base_hull, const RefinementMemory& memory);

  /// First crossing of the segment from `a_m` to `b_m` (mesh frame), either way.
  /// Bounds: <= budget steps but for the closure of the last; 5 KB of stack; not re-entrant.
  /// Result: least t; equal t: the lowest triangle in leaf order.
  RefinedHit first(math::Vec3 a_m, math::Vec3 b_m, query::Budget budget);

  /// A crossing of the mesh, the nearest that turns up first.
  RefinedHit any(math::Vec3 a_m, math::Vec3 b_m, query::Budget budget);

  /// Every crossing that the refinement finds, in order of t.
  RefinedCrossings all(math::Vec3 a_m, math::Vec3 b_m, query::Budget budget,
                       core::Span<mesh::SurfaceCrossing> buffer);

  /// The same with a triangle: crossings of triangles are told at t = 0, which way is not told. One
  /// that has a corner outside the shell and crosses none of its faces meets nothing of the mesh; of
  /// those that cross the mesh inside the hull alone some may be missed (hull/triangle_cast.hpp misses
  /// none).
  RefinedHit any(const math::Vec3 (&corner_m)[3], query::Budget budget);
  RefinedCrossings all(const math::Vec3 (&corner_m)[3], query::Budget budget,
                       core::Span<mesh::SurfaceCrossing> buffer);

  /// Undoes one collapse and what it needs, and keeps it until reset() or the next query: a hull
  /// finer where wanted.
  /// Result: false where the memory does not hold it; then nothing has changed.
  bool split(uint32_t collapse);
  /// Does everything again: the shell's own hull.
  void reset();
  /// Of the hull as it is now: faces of it are told one by one as vertex numbers.
  ///     for (Faces f(refinement); f.next();) use(f.number)
  class Faces;

  uint32_t split_count() const { return count_; }
  /// The most collapses undone by one query so far.
  uint32_t max_splits() const { return max_; }

 private:
  template <class Shape>
  class Search;
  bool is_split(uint32_t collapse) const {
    return (memory_.is_split[collapse / 32] >> (collapse % 32) & 1u) != 0;
  }
  bool add(uint32_t collapse);
  template <class Shape>
  RefinedHit nearest(const Shape& shape, query::Budget budget, bool is_any);
  template <class Shape>
  RefinedCrossings every(const Shape& shape, query::Budget budget,
                         core::Span<mesh::SurfaceCrossing> buffer);

  const View& hull_;
  const BaseHull& base_hull_;
  RefinementMemory memory_;
  uint32_t count_ = 0, max_ = 0;
};

/// The faces of a refinement's hull, one by one.
class Refinement::Faces {
 public:
  explicit Faces(const Refinement& refinement) : of_(refinement) {}
  /// Result: false where there are no more.
  bool next();
  uint32_t number[3] = {};  // of its vertices, counter-clockwise from outside

 private:
  const Refinement& of_;
  uint32_t at_ = 0, face_ = 0;
};

}  // namespace firmtouch::hull
