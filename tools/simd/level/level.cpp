// The wide search, compiled once per level with -Dfirmtouch=... and -DFIRMTOUCH_LEVEL=...
// (levels.hpp).

#include <new>

// What controllers compile for size, as GCC does [[gnu::cold]] functions, hosts compile for speed.
#define cold hot

#include "firmtouch/mesh/crossing_takers.hpp"
#include "firmtouch/mesh/direction.hpp"
#include "firmtouch/mesh/nearest_answer.hpp"
#include "simd/levels.hpp"
#include "simd/search/nearest.hpp"
#include "simd/search/segment.hpp"

// The rest of the search that is not inline.
#include "../../../firmware/firmtouch/mesh/compensated_distance.cpp"  // NOLINT
#include "../../../firmware/firmtouch/mesh/direction.cpp"             // NOLINT
#include "../../../firmware/firmtouch/mesh/exact_crossing.cpp"        // NOLINT

namespace firmtouch::simd {
namespace {

struct WideFinder {
  static constexpr bool kIsForSpeed = true;
  const View& mesh;
  const WideTree& tree;
  uint32_t triangle_low;  // mesh::Hint::triangle_low

  template <bool kCompensated, class Bound>
  bool find(const Bound& bound, Search& search) const {
    if constexpr (kCompensated) {
      return mesh::search_nearest<true, Bound, void>(mesh, bound, search);
    } else {
      if (mesh.leaf_boxes() != nullptr && (mesh.has_rivals() || mesh.triangles16().empty()))
        return mesh::search_nearest<false, Bound, mesh::WithRivals>(mesh, bound, search);
      if (mesh.leaf_boxes() != nullptr)
        return mesh::search_nearest<false, Bound, mesh::Boxed>(mesh, bound, search);
      if (search.budget != query::kUnlimited.work) return find_within_budget(bound, search);
      if (mesh.has_rivals()) return find_unlimited<true>(bound, search);
      return find_unlimited<false>(bound, search);
    }
  }
  Vec3 direction(const Best& best) const {
    const Vertex& v =
        tree.directions[size_t{kFeatures} * best.triangle + static_cast<uint32_t>(best.feature)];
    return {v.x_m, v.y_m, v.z_m};
  }
  // Inlined: a point that a call returns waits for the stores of its floats.
  [[gnu::always_inline]] static inline Vec3 in_box_frame(const View& mesh, const Vec3& p_m) {
    return mesh.box_frame() == nullptr ? p_m : mesh::in_frame(*mesh.box_frame(), p_m);
  }
  // Branchless: no predictor learns when a path passes through the surface.
  static int sign(float height_m, float doubt_m) {
    return static_cast<int>(height_m > doubt_m) - static_cast<int>(height_m < -doubt_m);
  }

 private:
  template <bool kRivals, class Bound>
  bool find_unlimited(const Bound& bound, Search& search) const {
    search.charged = 0;
    search.parts = search.start == query::kNowhere
                       ? search_cold<kRivals>(mesh, tree, bound, search)
                       : search_warm<kRivals>(mesh, tree, bound, triangle_low, search);
    return true;
  }
  template <class Bound>
  bool find_within_budget(const Bound& bound, Search& search) const {
    if (mesh.has_rivals())
      return mesh::search_nearest<false, Bound, mesh::WithRivals>(mesh, bound, search);
    if (!mesh.triangles16().empty())
      return mesh::search_nearest<false, Bound, uint16_t>(mesh, bound, search);
    return mesh::search_nearest<false, Bound, uint32_t>(mesh, bound, search);
  }
};

Vec3 vector(const float* v) { return {v[0], v[1], v[2]}; }
template <class Type>
const Type& as(const void* object) {
  return *static_cast<const Type*>(object);
}

void closest_point(const void* mesh, const void* tree, const float* p_m, const void* budget,
                   void* hint, void* closest) {
  const View& view = as<View>(mesh);
  mesh::Hint& last = *static_cast<mesh::Hint*>(hint);
  const WideFinder finder{view, as<WideTree>(tree), last.triangle_low};
  new (closest)
      mesh::Closest(mesh::closest_by(view, finder, vector(p_m), as<query::Budget>(budget), last));
}

template <class Visitor>
void find_hit(const void* mesh, const void* tree, const float* a_m, const float* b_m,
              const void* budget, void* to) {
  mesh::Hit& hit = *static_cast<mesh::Hit*>(to);  // in place: a copy waits for its stores
  Visitor visitor(hit);
  hit.exact = search_segment(as<View>(mesh), as<WideTree>(tree), vector(a_m), vector(b_m),
                             as<query::Budget>(budget), visitor, hit.steps);
}

void all_crossings(const void* mesh, const void* tree, const float* a_m, const float* b_m,
                   const void* budget, void* buffer, uint32_t size, void* to) {
  mesh::All all({static_cast<mesh::SurfaceCrossing*>(buffer), size});
  all.crossings.exact = search_segment(as<View>(mesh), as<WideTree>(tree), vector(a_m), vector(b_m),
                                       as<query::Budget>(budget), all, all.crossings.steps);
  *static_cast<mesh::Crossings*>(to) = all.crossings;
}

}  // namespace
}  // namespace firmtouch::simd

namespace firmtouch_simd {
extern const Searches FIRMTOUCH_LEVEL;
const Searches FIRMTOUCH_LEVEL{
    firmtouch::simd::closest_point, firmtouch::simd::find_hit<firmtouch::mesh::First>,
    firmtouch::simd::find_hit<firmtouch::mesh::Any>, firmtouch::simd::all_crossings};
}  // namespace firmtouch_simd
