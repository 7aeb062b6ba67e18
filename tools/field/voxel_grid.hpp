#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "surface/point.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// Cubes of one size, x fastest.
struct VoxelGrid {
  Point low_m;  // corner of voxel 0, 0, 0
  double size_m = 0;
  std::array<uint32_t, 3> count{};

  size_t voxels() const { return size_t{count[0]} * count[1] * count[2]; }
  size_t index(uint32_t x, uint32_t y, uint32_t z) const {
    return (size_t{z} * count[1] + y) * count[0] + x;
  }
  Point centre_m(double x, double y, double z) const {
    return {low_m.x + (x + 0.5) * size_m, low_m.y + (y + 0.5) * size_m,
            low_m.z + (z + 0.5) * size_m};
  }
};

/// The box of all surfaces, its long axis cut into `long_axis` voxels.
/// Pre: each has a vertex; not all vertices are one point; long_axis >= 1.
VoxelGrid make_voxel_grid(const std::vector<const Surface*>& surfaces, uint32_t long_axis);

enum class Voxel : uint8_t { kOutside, kSurface, kInside };

/// What each voxel of the grid is to one surface: kSurface where a triangle has a point in it
/// (touching counts; a voxel that misses all by less than 1e-9 of the grid may count too), of the
/// others kOutside those that a flood from beyond the grid reaches through faces of voxels, kInside
/// the rest.
std::vector<Voxel> voxelize(const Surface& surface, const VoxelGrid& grid);

/// Whether a triangle and a box (centre, half sides) have a point in common.
/// Source: Akenine-Moeller 2001 (thirteen separating axes).
bool triangle_meets_box(const std::array<Point, 3>& triangle, Point centre, Point half);

}  // namespace firmtouch::tools
