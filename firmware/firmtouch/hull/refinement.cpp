#include "firmtouch/hull/refinement.hpp"

#include "firmtouch/core/bisect.hpp"
#include "firmtouch/hull/base_hull_segment.hpp"
#include "firmtouch/hull/box_descent.hpp"
#include "firmtouch/hull/nearest_candidates.hpp"
#include "firmtouch/hull/triangle_region.hpp"
#include "firmtouch/mesh/crossing_takers.hpp"

namespace firmtouch::hull {
namespace {

using math::Vec3;

uint32_t triangle_of(const BaseHull& base_hull, uint32_t face) {
  const core::Span<const BaseHullTriangle> all = base_hull.triangles();
  return all[core::last_that(all.size(), [&](uint32_t i) { return all[i].face <= face; })].triangle;
}

// Shape that a refinement is queried with. enter(): time at which it meets a box, above `limit` if
// it does not. crossing(): of a face. base_hull_faces(): faces of the base hull that it may cross.
class SegmentQuery {
 public:
  SegmentQuery(const Head& head, Vec3 a_m, Vec3 b_m)
      : a_m_(a_m), b_m_(b_m), slabs_(a_m, b_m), frame_(head.low_m, head.high_m, a_m, b_m) {}

  float enter(const Box& box, float limit) const { return slabs_.enter(box, limit); }
  mesh::Crossing crossing(const FacePoints& face) const {
    return frame_.crossing(face.p_m, face.q_m, face.r_m);
  }
  template <class Face>
  bool base_hull_faces(const BaseHull& base_hull, float limit, query::Work& work, Face face) const {
    const BaseHullSegment segment(base_hull, a_m_, b_m_);
    Faces<Face> faces{segment.until(limit), face};
    return descend(base_hull, segment, work, faces);
  }

 private:
  template <class Face>
  struct Faces {
    int32_t limit;
    Face& use;
    bool face(const BaseHull::Leaf& leaf, uint32_t n) {
      use(leaf.first_face + n);
      return true;
    }
  };
  Vec3 a_m_, b_m_;
  Slabs slabs_;
  mesh::SegmentFrame frame_;
};

// Everything that a triangle crosses is reported at t = 0.
class TriangleQuery {
 public:
  TriangleQuery(const Head& head, const Vec3 (&corner_m)[3]) : region_(box_of(head), corner_m) {}

  float enter(const Box& box, float limit) const { return region_.enter(box, limit); }
  mesh::Crossing crossing(const FacePoints& face) const {
    return {region_.crosses(face) ? int8_t{1} : int8_t{0}, 0.0f};
  }
  template <class Face>
  bool base_hull_faces(const BaseHull& base_hull, float, query::Work& work, Face face) const {
    return faces_near(base_hull, region_, work, [&](const BaseHull::Leaf& leaf, uint32_t n) {
      face(leaf.first_face + n);
      return true;
    });
  }

 private:
  TriangleRegion region_;
};

}  // namespace

/// The faces that the shape of a query crosses, passed on as candidates.
template <class Shape>
class Refinement::Search {
 public:
  float limit = 1;
  uint32_t tests = 0;

  Search(Refinement& of, const Shape& shape, query::Budget budget)
      : of_(of), shape_(shape), work_(budget) {}

  const query::Work& work() const { return work_; }

  /// Faces of the base hull. Result: false if the budget ran out.
  template <class Use>
  bool base_hull(Use use) {
    return shape_.base_hull_faces(of_.base_hull_, limit, work_,
                                  [&](uint32_t face) { base_hull_face(face, use); });
  }

  /// Faces in the star of a collapse that was split back, as far as they exist.
  template <class Use>
  void star(uint32_t collapse, Use use) {
    const View& hull = of_.hull_;
    (void)work_.visit();
    const Vec3 about_m = made_vertex(hull, collapse);
    const Box box = star_box_m(about_m, hull.head().cell_m, hull.star_box(collapse));
    if (!(shape_.enter(box, limit) <= limit)) return;
    const uint8_t* record = hull.record(collapse);
    const Star star(hull, collapse, record);
    Vec3 at_m[2 + kMaxLink];
    for (uint32_t i = 0; i < 2 + star.link; ++i) at_m[i] = vertex(hull, star.number[i]);
    const uint32_t mesh_vertices = hull.head().mesh_vertex_count;
    uint32_t triangle = 1 + star.link;
    for (uint32_t i = 0; i < star.face_count(); ++i) {
      uint32_t corner[3];
      star.face(i, corner);
      const uint32_t youngest = star.youngest(corner);
      const bool is_of_mesh = youngest < mesh_vertices;
      if (is_of_mesh) {
        mesh_triangle(hull.id_in(record, triangle++), use);
        continue;
      }
      if (of_.is_split(youngest - mesh_vertices)) continue;
      test({at_m[corner[0]], at_m[corner[1]], at_m[corner[2]]}, youngest - mesh_vertices, use);
    }
  }

 private:
  template <class Use>
  void base_hull_face(uint32_t i, Use& use) {
    const BaseHull& base_hull = of_.base_hull_;
    uint32_t corner[3];
    bool is_made = false;
    for (uint32_t k = 0; k < 3; ++k) {
      corner[k] = base_hull.vertex_of(i, k);
      is_made = is_made || base_hull.is_made(corner[k]);
    }
    if (!is_made) return mesh_triangle(triangle_of(base_hull, i), use);
    const auto of_face = [&](const Candidate& candidate) {
      uint32_t youngest = 0;
      for (const uint32_t vertex : corner) {
        const uint32_t number = of_.hull_.number_of(base_hull.id_of(vertex));
        youngest = number > youngest ? number : youngest;
      }
      const uint32_t maker = youngest - of_.hull_.head().mesh_vertex_count;
      use(Candidate{candidate.t, candidate.what | maker});
    };
    test({vertex(base_hull, corner[0]), vertex(base_hull, corner[1]), vertex(base_hull, corner[2])},
         0, of_face);
  }

  // With the mesh's own order of corners: to the bit what the mesh answers.
  template <class Use>
  void mesh_triangle(uint32_t i, Use& use) {
    test(points_of(of_.hull_, i), i | kOfMesh, use);
  }

  template <class Use>
  void test(const FacePoints& face, uint32_t what, Use& use) {
    ++tests;
    const mesh::Crossing crossing = shape_.crossing(face);
    if (crossing.direction == 0) return;
    use(Candidate{crossing.t, what | (crossing.direction < 0 ? kEnters : 0u)});
  }

  Refinement& of_;
  const Shape& shape_;
  query::Work work_;
};

Refinement::Refinement(const View& hull, const BaseHull& base_hull, const RefinementMemory& memory)
    : hull_(hull), base_hull_(base_hull), memory_(memory) {
  for (uint32_t& word : memory_.is_split) word = 0;
}

// False: no room for one more.
bool Refinement::add(uint32_t collapse) {
  if (collapse >= base_hull_.head().cut || is_split(collapse)) return true;
  if (count_ == memory_.splits.size()) return false;
  memory_.is_split[collapse / 32] |= 1u << (collapse % 32);
  memory_.splits[count_++] = collapse;
  return true;
}

bool Refinement::split(uint32_t collapse) {
  const uint32_t before = count_;
  bool fits = add(collapse);
  for (uint32_t at = before; fits && at < count_; ++at) {
    const uint8_t* record = hull_.record(memory_.splits[at]);
    const uint32_t ids = 1 + link_of(View::head_of(record));
    for (uint32_t i = 0; fits && i < ids; ++i) fits = add(removed_by(hull_.id_in(record, i)));
  }
  while (!fits && count_ > before) {
    const uint32_t last = memory_.splits[--count_];
    memory_.is_split[last / 32] &= ~(1u << (last % 32));
  }
  return fits;
}

void Refinement::reset() {
  for (uint32_t i = 0; i < count_; ++i) memory_.is_split[memory_.splits[i] / 32] = 0;
  count_ = 0;
}

RefinedHit Refinement::first(Vec3 a_m, Vec3 b_m, query::Budget budget) {
  if (!(math::is_finite(a_m) && math::is_finite(b_m))) return {};
  return nearest(SegmentQuery(hull_.head(), a_m, b_m), budget, false);
}
RefinedHit Refinement::any(Vec3 a_m, Vec3 b_m, query::Budget budget) {
  if (!(math::is_finite(a_m) && math::is_finite(b_m))) return {};
  return nearest(SegmentQuery(hull_.head(), a_m, b_m), budget, true);
}
RefinedCrossings Refinement::all(Vec3 a_m, Vec3 b_m, query::Budget budget,
                                 core::Span<mesh::SurfaceCrossing> buffer) {
  if (!(math::is_finite(a_m) && math::is_finite(b_m))) return {};
  return every(SegmentQuery(hull_.head(), a_m, b_m), budget, buffer);
}

RefinedHit Refinement::any(const Vec3 (&corner_m)[3], query::Budget budget) {
  if (!is_finite(corner_m)) return {};
  return nearest(TriangleQuery(hull_.head(), corner_m), budget, true);
}
RefinedCrossings Refinement::all(const Vec3 (&corner_m)[3], query::Budget budget,
                                 core::Span<mesh::SurfaceCrossing> buffer) {
  if (!is_finite(corner_m)) return {};
  return every(TriangleQuery(hull_.head(), corner_m), budget, buffer);
}

// The nearest crossing of the hull as it is can never lie behind the mesh's: where it is one of the
// mesh, that is the answer; else its face is replaced.
template <class Shape>
RefinedHit Refinement::nearest(const Shape& shape, query::Budget budget, bool is_any) {
  RefinedHit hit;
  reset();
  Search<Shape> search(*this, shape, budget);
  Nearest queue(memory_.candidates);
  const auto keep = [&](const Candidate& candidate) {
    if (candidate.t <= search.limit) queue.push(candidate);
  };
  const auto report = [&](const Candidate& candidate) {
    hit.hit = true;
    hit.is_of_mesh = (candidate.what & kOfMesh) != 0;
    hit.triangle = hit.is_of_mesh ? candidate.what & kIndex : 0;
    hit.t = candidate.t;
    hit.enters = (candidate.what & kEnters) != 0;
  };
  hit.exact = search.base_hull(keep);
  if (!hit.exact) report({0.0f, kEnters});  // a face that was not looked at may be crossed at once
  while (hit.exact && !queue.is_empty()) {
    const Candidate now = queue.pop();
    if (now.t > search.limit) break;
    if (!hit.hit && now.t >= queue.horizon) break;
    const uint32_t index = now.what & kIndex;
    if ((now.what & kOfMesh) != 0) {
      const bool is_first = !hit.hit || now.t < hit.t || (now.t <= hit.t && index < hit.triangle);
      if (is_first) report(now);
      if (is_any) break;
      // A face that is crossed later in truth may have an earlier computed time.
      search.limit = mesh::smaller(hit.t + 2.0f * mesh::kTimeError, search.limit);
      continue;
    }
    if (is_split(index)) continue;
    const uint32_t before = count_;
    if (search.work().left == 0 || !split(index)) {
      if (!hit.hit) report(now);
      hit.exact = false;
      break;
    }
    for (uint32_t at = before; at < count_; ++at) search.star(memory_.splits[at], keep);
  }
  if (queue.horizon <= search.limit) {  // one that had to give way may have been nearer
    if (!hit.hit) report({queue.horizon, kEnters});
    hit.exact = false;
  }
  hit.steps = search.work().visits();
  hit.tests = search.tests;
  hit.splits = count_;
  reset();
  return hit;
}

template <class Shape>
RefinedCrossings Refinement::every(const Shape& shape, query::Budget budget,
                                   core::Span<mesh::SurfaceCrossing> buffer) {
  RefinedCrossings result;
  reset();
  Search<Shape> search(*this, shape, budget);
  mesh::All all(buffer);
  bool fits = true;
  // What an earlier one has replaced meanwhile is left out.
  const auto use = [&](const Candidate& candidate) {
    const uint32_t index = candidate.what & kIndex;
    if ((candidate.what & kOfMesh) == 0) {
      fits = split(index) && fits;
      return;
    }
    const int8_t direction = (candidate.what & kEnters) != 0 ? int8_t{-1} : int8_t{1};
    (void)all.take({direction, candidate.t}, index);
  };
  result.exact = search.base_hull(use);
  for (uint32_t at = 0; at < count_; ++at) {
    if (search.work().left == 0) {
      result.exact = false;
      break;
    }
    search.star(memory_.splits[at], use);
  }
  result.exact = result.exact && fits;
  result.found = all.crossings.found;
  result.reported = all.crossings.reported;
  result.steps = search.work().visits();
  result.tests = search.tests;
  result.splits = count_;
  reset();
  return result;
}

}  // namespace firmtouch::hull
