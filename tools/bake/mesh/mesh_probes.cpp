#include "bake/asset/probes.hpp"
#include "firmtouch/mesh/closest_point.hpp"

namespace firmtouch::tools {

Section mesh_probes(const mesh::View& mesh, const std::string& name) {
  const auto points = probe_points(mesh.head().low_m, mesh.head().high_m,
                                   anchors_of(mesh.vertices()), kProbesAGeometry);
  return answered_probes(mesh::kProbesSection, name, mesh, points);
}

}  // namespace firmtouch::tools
