#include "field/voxel_grid.hpp"

#include <algorithm>
#include <cmath>

#include "surface/box_tree.hpp"

namespace firmtouch::tools {
namespace {

// Voxels are taken this share of the grid's long axis larger, so that no rounding opens a gap.
constexpr double kSlack = 1e-9;

Box box_of(const std::vector<Point>& points) {
  Box box{points[0], points[0]};
  for (const Point& p : points) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y), std::min(box.low.z, p.z)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y), std::max(box.high.z, p.z)};
  }
  return box;
}

struct Range {
  uint32_t begin, end;
};

// The voxels of one axis that low..high meets.
Range range_of(double low, double high, double origin, double size, uint32_t count) {
  const double most = count - 1.0;
  const double first = std::floor((low - origin) / size - kSlack * count);
  const double last = std::floor((high - origin) / size + kSlack * count);
  return {static_cast<uint32_t>(std::clamp(first, 0.0, most)),
          static_cast<uint32_t>(std::clamp(last, 0.0, most)) + 1};
}

void mark_surface(const Surface& surface, const VoxelGrid& grid, std::vector<Voxel>& voxels) {
  const double half =
      grid.size_m * (0.5 + kSlack * std::max({grid.count[0], grid.count[1], grid.count[2]}));
  for (const Face& face : surface.faces) {
    const std::array<Point, 3> corners{to_point(surface.vertices[face[0]]),
                                       to_point(surface.vertices[face[1]]),
                                       to_point(surface.vertices[face[2]])};
    const Box box = box_of({corners[0], corners[1], corners[2]});
    const Range xs = range_of(box.low.x, box.high.x, grid.low_m.x, grid.size_m, grid.count[0]);
    const Range ys = range_of(box.low.y, box.high.y, grid.low_m.y, grid.size_m, grid.count[1]);
    const Range zs = range_of(box.low.z, box.high.z, grid.low_m.z, grid.size_m, grid.count[2]);
    for (uint32_t z = zs.begin; z < zs.end; ++z)
      for (uint32_t y = ys.begin; y < ys.end; ++y)
        for (uint32_t x = xs.begin; x < xs.end; ++x) {
          Voxel& voxel = voxels[grid.index(x, y, z)];
          if (voxel == Voxel::kSurface) continue;
          if (triangle_meets_box(corners, grid.centre_m(x, y, z), {half, half, half}))
            voxel = Voxel::kSurface;
        }
  }
}

// Everything is inside until the flood reaches it.
class Flood {
 public:
  Flood(const VoxelGrid& grid, std::vector<Voxel>& voxels) : grid_(grid), voxels_(voxels) {}

  void run() {
    const auto [nx, ny, nz] = grid_.count;
    for (uint32_t z = 0; z < nz; ++z)
      for (uint32_t y = 0; y < ny; ++y)
        for (const uint32_t x : {0u, nx - 1}) enter(x, y, z);
    for (uint32_t z = 0; z < nz; ++z)
      for (uint32_t x = 0; x < nx; ++x)
        for (const uint32_t y : {0u, ny - 1}) enter(x, y, z);
    for (uint32_t y = 0; y < ny; ++y)
      for (uint32_t x = 0; x < nx; ++x)
        for (const uint32_t z : {0u, nz - 1}) enter(x, y, z);
    while (!front_.empty()) {
      const auto [x, y, z] = front_.back();
      front_.pop_back();
      if (x > 0) enter(x - 1, y, z);
      if (x + 1 < nx) enter(x + 1, y, z);
      if (y > 0) enter(x, y - 1, z);
      if (y + 1 < ny) enter(x, y + 1, z);
      if (z > 0) enter(x, y, z - 1);
      if (z + 1 < nz) enter(x, y, z + 1);
    }
  }

 private:
  void enter(uint32_t x, uint32_t y, uint32_t z) {
    Voxel& voxel = voxels_[grid_.index(x, y, z)];
    if (voxel != Voxel::kInside) return;
    voxel = Voxel::kOutside;
    front_.push_back({x, y, z});
  }

  const VoxelGrid& grid_;
  std::vector<Voxel>& voxels_;
  std::vector<std::array<uint32_t, 3>> front_;
};

}  // namespace

VoxelGrid make_voxel_grid(const std::vector<const Surface*>& surfaces, uint32_t long_axis) {
  std::vector<Point> points;
  for (const Surface* surface : surfaces)
    for (const math::Vec3& v : surface->vertices) points.push_back(to_point(v));
  const Box box = box_of(points);
  const Point side = box.high - box.low;
  VoxelGrid grid;
  grid.size_m = std::max({side.x, side.y, side.z}) / long_axis;
  const double sides[3] = {side.x, side.y, side.z};
  for (size_t k = 0; k < 3; ++k) {
    const double cells = std::ceil(sides[k] / grid.size_m - kSlack * long_axis);
    grid.count[k] = static_cast<uint32_t>(std::max(cells, 1.0));
  }
  const Point spare{grid.count[0] * grid.size_m - side.x, grid.count[1] * grid.size_m - side.y,
                    grid.count[2] * grid.size_m - side.z};
  grid.low_m = box.low - spare * 0.5;
  return grid;
}

std::vector<Voxel> voxelize(const Surface& surface, const VoxelGrid& grid) {
  std::vector<Voxel> voxels(grid.voxels(), Voxel::kInside);
  mark_surface(surface, grid, voxels);
  Flood(grid, voxels).run();
  return voxels;
}

bool triangle_meets_box(const std::array<Point, 3>& triangle, Point centre, Point half) {
  const Point v[3] = {triangle[0] - centre, triangle[1] - centre, triangle[2] - centre};
  const auto apart = [](double a, double b, double c, double reach) {
    return std::min({a, b, c}) > reach || std::max({a, b, c}) < -reach;
  };
  if (apart(v[0].x, v[1].x, v[2].x, half.x) || apart(v[0].y, v[1].y, v[2].y, half.y) ||
      apart(v[0].z, v[1].z, v[2].z, half.z))
    return false;
  const Point edges[3] = {v[1] - v[0], v[2] - v[1], v[0] - v[2]};
  const Point normal = cross(edges[0], edges[1]);
  const auto reach_along = [&](Point axis) {
    return half.x * std::fabs(axis.x) + half.y * std::fabs(axis.y) + half.z * std::fabs(axis.z);
  };
  // The slack of the box is far above the rounding of these products.
  if (std::fabs(dot(normal, v[0])) > reach_along(normal)) return false;
  for (const Point& e : edges) {
    const Point axes[3] = {{0, -e.z, e.y}, {e.z, 0, -e.x}, {-e.y, e.x, 0}};
    for (const Point& axis : axes)
      if (apart(dot(axis, v[0]), dot(axis, v[1]), dot(axis, v[2]), reach_along(axis))) return false;
  }
  return true;
}

}  // namespace firmtouch::tools
