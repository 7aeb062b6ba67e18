#include "bake/asset/probes.hpp"
#include "firmtouch/mesh/closest_point.hpp"

namespace firmtouch::tools {

Section mesh_probes(const mesh::View& mesh, const std::string& name) {
  return probes_about(mesh::kProbesSection, name, mesh, mesh.vertices());
}

}  // namespace firmtouch::tools
