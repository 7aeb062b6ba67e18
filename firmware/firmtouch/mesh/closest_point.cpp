#include "firmtouch/mesh/closest_point.hpp"

#include "firmtouch/mesh/direction.hpp"
#include "firmtouch/mesh/nearest_answer.hpp"

namespace firmtouch::mesh {
namespace {

struct ScalarFinder {
  static constexpr bool kIsForSpeed = false;
  const View& mesh;

  template <bool kCompensated, class Bound>
  bool find(const Bound& bound, Search& search) const {
    if constexpr (kCompensated)
      return search_nearest<true, Bound, void>(mesh, bound, search);
    else if (mesh.has_rivals() || mesh.triangles16().empty())
      // 32 bits are rare on a controller: a loop of their own takes 3 kB
      return search_nearest<false, Bound, WithRivals>(mesh, bound, search);
    else if (mesh.leaf_boxes() != nullptr)
      return search_nearest<false, Bound, Boxed>(mesh, bound, search);
    else
      return search_nearest<false, Bound, uint16_t>(mesh, bound, search);
  }
  [[gnu::always_inline]] inline Vec3 direction(const Best& best) const {
    return feature_direction(mesh, best.triangle, best.feature);
  }
  [[gnu::always_inline]] static inline Vec3 in_box_frame(const View& mesh, const Vec3& p_m) {
    return mesh::in_box_frame(mesh, p_m);
  }
  static int sign(float height_m, float doubt_m) {
    if (height_m > doubt_m) return 1;
    return height_m < -doubt_m ? -1 : 0;
  }
};

}  // namespace

Closest closest_point(const View& mesh, Vec3 p_m, query::Budget budget, Hint& hint) {
  return closest_by(mesh, ScalarFinder{mesh}, p_m, budget, hint);
}

Foot foot_on(Vec3 p, const OfCorners& triangle) {
  Foot foot;
  find_foot_apart(p, triangle, Nearer::than_nothing(), foot);
  return foot;
}

void Prober::answer(const View& mesh, Vec3 p_m, const query::Budget& budget, core::Hash& hash) {
  const Closest c = closest_point(mesh, p_m, budget, hint);
  const float values[] = {c.distance_m,  c.point_m.x,   c.point_m.y,   c.point_m.z,
                          c.direction.x, c.direction.y, c.direction.z, c.certificate.lower_m};
  for (const float value : values) hash.add(math::bits_of(value));
  hash.add(c.triangle);
  hash.add(static_cast<uint32_t>(c.feature));
  hash.add(c.certificate.steps);
}

uint64_t probe_hash(const View& mesh, core::Span<const query::ProbePoint> points) {
  return query::hash_of_run<ProbeRun>(mesh, points);
}

}  // namespace firmtouch::mesh
