#include "firmtouch/mesh/direction.hpp"

namespace firmtouch::mesh {

math::Vec3 border_direction(const View& mesh, uint32_t triangle, Feature feature,
                            math::Vec3 normal) {
  const Triangle<uint32_t> t = mesh.triangle(triangle);
  if (is_vertex(feature)) {
    const uint32_t corner =
        static_cast<uint32_t>(feature) - static_cast<uint32_t>(Feature::kVertex0);
    return decode_vertex_normal(mesh.vertex_normals()[t.corner[corner]]);
  }
  const uint32_t k = static_cast<uint32_t>(feature) - static_cast<uint32_t>(Feature::kEdge0);
  const math::Vec3 edge = mesh.vertex(t.corner[k == 2 ? 0 : k + 1]) - mesh.vertex(t.corner[k]);
  return decode_edge_normal(normal, edge, mesh.folds()[triangle].fold[k]);
}

}  // namespace firmtouch::mesh
