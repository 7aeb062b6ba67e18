#include "bake/asset/probes.hpp"
#include "firmtouch/hull/probes.hpp"

namespace firmtouch::tools {

Section hull_probes(const hull::View& hull, const std::string& name) {
  const mesh::Head& head = hull.mesh_head();
  std::vector<math::Vec3> anchors_m;
  const uint32_t step = head.vertex_count / 1024 + 1;
  for (uint32_t i = 0; i < head.vertex_count; i += step) anchors_m.push_back(hull.mesh_vertex(i));
  const auto points = probe_points(head.low_m, head.high_m, anchors_m, kProbesAGeometry);
  const core::Span<const query::ProbePoint> span(points.data(),
                                                 static_cast<uint32_t>(points.size()));
  return probe_section(hull::kProbesSection, name, points, hull::probe_hash(hull, span));
}

bool hull_probes_agree(const hull::View& hull, core::Bytes bytes) {
  const query::Probes probes = query::read_probes(bytes);
  return !probes.points.empty() && hull::probe_hash(hull, probes.points) == probes.hash;
}

}  // namespace firmtouch::tools
