#pragma once
#include <cstdint>
#include <vector>

#include "surface/point.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// Where the vertices of coarser hulls may lie: low + k * cell with 0 <= k < 2^bits on each axis.
/// The cell is a power of two and each such number is a float32 exactly, so that a reader finds the
/// very vertex that was proven.
struct HullGrid {
  Point low_m;
  double cell_m = 0;
  uint32_t bits = 22;

  /// The nearest grid point. Result: false where that is off the grid.
  bool snap(Point p_m, math::Vec3& snapped_m) const;
};

/// The grid of a surface: an eighth of its extent or more is free on each side of it.
HullGrid grid_for(const Surface& surface, uint32_t bits);

/// One edge collapse: the vertices u and v give way to a new one, outside all faces around them.
struct Collapse {
  uint32_t u, v;
  // The link of the new vertex, counter-clockwise from outside: links[first_link], ...; its first
  // `split` edges are those opposite u, the others those opposite v. u, v, link[0] and v, u,
  // link[split] were the faces of the edge.
  uint32_t first_link, link_count, split;
  double volume_m3;  // between the faces before and after
};

/// A mesh and the collapses that make it coarser and coarser, each hull enclosing the one before.
/// Vertices 0 to mesh_vertices - 1 are the mesh's; mesh_vertices + k is the new one of collapse k.
struct ProgressiveHull {
  uint32_t mesh_vertices = 0;
  std::vector<math::Vec3> vertices_m;
  std::vector<Face> mesh_faces;
  std::vector<Collapse> collapses;
  std::vector<uint32_t> links;
  std::vector<uint32_t> removed_by;  // of each vertex: the collapse that removes it, or kNone
  HullGrid grid;

  uint32_t min_faces() const {
    return static_cast<uint32_t>(mesh_faces.size() - 2 * collapses.size());
  }
};

/// The hull after the first `collapses` collapses, each of its faces at the index of the mesh's
/// face that it grew from (`source`). Vertices keep their numbers; those not used are left in.
Surface hull_after(const ProgressiveHull& hull, uint32_t collapses);

/// The finest hull of at most `faces` faces, or the coarsest there is; without unused vertices.
Surface hull_level(const ProgressiveHull& hull, uint32_t faces);

/// Outward volume positive.
double enclosed_volume_m3(const Surface& surface);

}  // namespace firmtouch::tools
