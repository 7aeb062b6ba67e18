#pragma once
#include <utility>
#include <vector>

#include "bake/mesh/bake_mesh.hpp"
#include "brute_force.hpp"
#include "firmtouch/mesh/view.hpp"
#include "harness/test.hpp"
#include "surface/make/make_part.hpp"

namespace firmtouch::mesh_test {

/// A surface, baked and opened; without faces (a model that is not there) neither.
struct BakedMesh {
  tools::Surface surface;
  std::vector<tools::Section> sections;
  mesh::View view;
  double moved_m = 0;  // the surface, by tools::refine()
  double size = 0;

  explicit BakedMesh(tools::Surface from, const tools::MeshOptions& options = {})
      : surface(std::move(from)) {
    if (surface.faces.empty()) return;
    tools::MeshReport report;
    sections = tools::bake_mesh(surface, "model", options, report);
    CHECK(report.problem.empty());
    moved_m = report.refined.moved_m;
    CHECK(mesh::open(parts(), view).ok());
    size = diagonal(surface);
  }
  BakedMesh(const tools::Surface& from, const tools::TreeShape& shape)
      : BakedMesh(from, options_of(shape)) {}
  mesh::Sections parts() const { return tools::sections_of<mesh::Sections>(sections, "model"); }

 private:
  static tools::MeshOptions options_of(const tools::TreeShape& shape) {
    tools::MeshOptions options;
    options.shape = shape;
    return options;
  }
};

/// The demo's part.
inline const BakedMesh& part() {
  static const BakedMesh baked(tools::make_part(1, 5000));
  return baked;
}

}  // namespace firmtouch::mesh_test
