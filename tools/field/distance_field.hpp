#pragma once
#include <cstdint>
#include <functional>
#include <vector>

#include "field/foot.hpp"
#include "field/triangle_tree.hpp"
#include "field/voxel_grid.hpp"

namespace firmtouch::tools {

/// A closed surface made ready for distances; refers to it.
struct Solid {
  explicit Solid(const Surface& from) : surface(from), tree(from), sides(from) {}
  const Surface& surface;
  TriangleTree tree;
  SideTeller sides;
};

/// The nearest point of one or several solids. Distance is that to the nearest surface of any;
/// inside is what lies inside any.
struct Nearest {
  float distance_m = 0;  // negative inside
  math::Vec3 closest_m;
  uint32_t face = kNoFace;  // of the object's surface
  uint16_t object = 0;
  int8_t sign = 0;  // -1 inside, +1 outside, 0: not computed
};

struct FieldOptions {
  bool interior_only = false;  // voxels that a surface meets or that lie inside
  uint32_t threads = 1;
  // Called now and then with the share that is done, from any thread, one at a time.
  std::function<void(double)> on_progress;
};

struct DistanceField {
  VoxelGrid grid;
  std::vector<Voxel> kinds;  // inside any, else surface of any, else outside
  std::vector<Nearest> values;
  size_t outside = 0, surface = 0, inside = 0, computed = 0;
  double voxelize_s = 0, distance_s = 0;

  /// Voxels off every surface where flood fill and pseudonormal give different signs.
  struct Disagreement {
    size_t voxel;
    uint16_t object;
    bool flood_says_inside;
  };
  std::vector<Disagreement> disagreements;  // in the order of object and voxel
};

/// Kind, distance, closest point, triangle and side of every voxel's centre.
/// Result: the same for any number of threads.
/// Error: the returned triangle is nearest to within 1e-6 of the diagonal; its distance is computed
/// in
///        double.
/// Source: Morris 2006, section 3.
DistanceField make_distance_field(const std::vector<Solid>& solids, const VoxelGrid& grid,
                                  const FieldOptions& options);

}  // namespace firmtouch::tools
