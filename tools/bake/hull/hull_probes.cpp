#include "bake/asset/probes.hpp"
#include "firmtouch/hull/probes.hpp"

namespace firmtouch::tools {

Section hull_probes(const hull::View& hull, const std::string& name) {
  const mesh::Head& head = hull.mesh_head();
  std::vector<math::Vec3> anchors_m;
  const uint32_t step = head.vertex_count / 1024 + 1;
  for (uint32_t i = 0; i < head.vertex_count; i += step) anchors_m.push_back(hull.mesh_vertex(i));
  const auto points = probe_points(head.low_m, head.high_m, anchors_m, kProbesAGeometry);
  return answered_probes(hull::kProbesSection, name, hull, points);
}

}  // namespace firmtouch::tools
