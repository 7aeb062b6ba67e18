#pragma once
// Shapes baked with their hulls, for host tests.

#include "bake/hull/bake_hull.hpp"
#include "bake/mesh/bake_mesh.hpp"
#include "harness/test.hpp"
#include "surface/random.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// A mesh and its hull as sections.
struct BakedHull {
  Surface surface;  // in the order of the asset
  std::vector<Section> sections;
  HullBakeReport report;
  mesh::View mesh;
  hull::View view;

  BakedHull(const Surface& from, uint32_t faces, uint32_t grid_bits) {
    MeshReport mesh_report;
    sections = bake_mesh(from, "model", {}, mesh_report);
    CHECK(mesh_report.problem.empty());
    CHECK(open_baked(sections, "model", mesh).ok());
    HullOptions options;
    options.target_faces = faces;
    options.grid_bits = grid_bits;
    const std::vector<Section> hull = bake_hull(mesh, sections, "model", options, report);
    sections.insert(sections.end(), hull.begin(), hull.end());
    CHECK_EQ(open_baked(sections, "model", view).rule, 0);
    for (uint32_t i = 0; i < mesh.vertices().size(); ++i)
      surface.vertices.push_back(mesh.vertex(i));
    for (uint32_t i = 0; i < mesh.head().triangle_count; ++i) {
      const mesh::Triangle<uint32_t> t = mesh.triangle(i);
      surface.faces.push_back({t.corner[0], t.corner[1], t.corner[2]});
    }
  }
  BakedHull(const BakedHull&) = delete;
  BakedHull& operator=(const BakedHull&) = delete;
};

struct OnCircle {
  double cosine, sine;
};
/// Point `i` of 4 * `quarter` on a circle, without sines.
inline OnCircle on_circle(uint32_t i, uint32_t quarter) {
  const double t = 0.41421356237309503 * (2.0 * (i % quarter) / quarter - 1);
  const double c = (1 - t * t) / (1 + t * t), s = 2 * t / (1 + t * t);
  switch (i / quarter % 4) {
    case 0:
      return {c, s};
    case 1:
      return {-s, c};
    case 2:
      return {-c, -s};
    default:
      return {s, -c};
  }
}

/// A ring of 2 * 16 * around * across triangles with bumps.
inline Surface bumpy_ring(uint32_t around = 4, uint32_t across = 2, double bumps = 0.05) {
  Surface ring;
  Random random(8);
  const uint32_t rows = 4 * around, columns = 4 * across;
  for (uint32_t i = 0; i < rows; ++i) {
    for (uint32_t j = 0; j < columns; ++j) {
      const OnCircle u = on_circle(i, around), v = on_circle(j, across);
      const double r = 0.4 * (1 + random.between(-bumps, bumps)), out = 1 + r * v.cosine;
      ring.vertices.push_back({static_cast<float>(out * u.cosine), static_cast<float>(out * u.sine),
                               static_cast<float>(r * v.sine)});
      const uint32_t next = (i + 1) % rows, right = (j + 1) % columns;
      const uint32_t a = i * columns + j, b = next * columns + j, c = next * columns + right,
                     d = i * columns + right;
      ring.faces.push_back({a, b, c});
      ring.faces.push_back({a, c, d});
    }
  }
  for (uint32_t f = 0; f < ring.faces.size(); ++f) ring.source.push_back(f);
  return ring;
}

}  // namespace firmtouch::tools
