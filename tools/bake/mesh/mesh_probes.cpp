#include "bake/asset/probes.hpp"
#include "firmtouch/mesh/closest_point.hpp"

namespace firmtouch::tools {

Section mesh_probes(const mesh::View& mesh, const std::string& name) {
  const auto points = probe_points(mesh.head().low_m, mesh.head().high_m,
                                   anchors_of(mesh.vertices()), kProbesAGeometry);
  const core::Span<const query::ProbePoint> span(points.data(),
                                                 static_cast<uint32_t>(points.size()));
  return probe_section(mesh::kProbesSection, name, points, mesh::probe_hash(mesh, span));
}

bool mesh_probes_agree(const mesh::View& mesh, core::Bytes bytes) {
  const query::Probes probes = query::read_probes(bytes);
  return !probes.points.empty() && mesh::probe_hash(mesh, probes.points) == probes.hash;
}

}  // namespace firmtouch::tools
