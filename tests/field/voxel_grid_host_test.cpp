#include "field/oracle.hpp"
#include "field/voxel_grid.hpp"
#include "surface/make/make_part.hpp"
#include "surface/random.hpp"
#include "surface/shapes.hpp"

namespace firmtouch::tools {
namespace {

// Whether some point of a fine net over the triangle lies in the box.
bool net_meets_box(const std::array<Point, 3>& t, Point centre, double half) {
  constexpr int kNet = 200;
  for (int i = 0; i <= kNet; ++i)
    for (int j = 0; i + j <= kNet; ++j) {
      const Point p = t[0] + (t[1] - t[0]) * (static_cast<double>(i) / kNet) +
                      (t[2] - t[0]) * (static_cast<double>(j) / kNet) - centre;
      if (std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) <= half) return true;
    }
  return false;
}

}  // namespace

TEST(Triangle_MeetsTheBoxesOfItsSampledPoints) {
  Random random(3);
  const auto point = [&] {
    return Point{random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
  };
  size_t met = 0, missed = 0;
  for (int i = 0; i < 300; ++i) {
    const std::array<Point, 3> t{point(), point(), point()};
    const Point centre = point();
    const double half = random.between(0.05, 0.4);
    const bool reported = triangle_meets_box(t, centre, {half, half, half});
    // The net may miss a corner cut off by less than its mesh.
    if (net_meets_box(t, centre, half)) {
      CHECK(reported);
      ++met;
    } else if (!net_meets_box(t, centre, half + 0.02)) {
      CHECK(!reported);
      ++missed;
    }
  }
  CHECK_GT(met, 30u);
  CHECK_GT(missed, 30u);
}

TEST(TouchingCountsAsMeeting) {
  const Point half{1, 1, 1};
  CHECK(triangle_meets_box({Point{1, -3, -3}, {1, 3, -3}, {1, 0, 3}}, {0, 0, 0}, half));
  CHECK(triangle_meets_box({Point{1, 1, 1}, {2, 2, 1}, {2, 1, 2}}, {0, 0, 0}, half));
  CHECK(!triangle_meets_box({Point{1.001, 1, 1}, {2, 2, 1}, {2, 1, 2}}, {0, 0, 0}, half));
}

TEST(AVoxelOffTheSurfaceHoldsNoPointOfIt) {
  const Surface part = make_part(1, 1500);
  const VoxelGrid grid = make_voxel_grid({&part}, 18);
  const std::vector<Voxel> voxels = voxelize(part, grid);
  size_t wrong = 0, near = 0;
  for (uint32_t z = 0; z < grid.count[2]; ++z)
    for (uint32_t y = 0; y < grid.count[1]; ++y)
      for (uint32_t x = 0; x < grid.count[0]; ++x) {
        const double d = oracle_distance(part, grid.centre_m(x, y, z));
        const bool on = voxels[grid.index(x, y, z)] == Voxel::kSurface;
        if (d < 0.4999 * grid.size_m && !on) ++wrong;  // the ball inside the voxel
        if (d > 0.8661 * grid.size_m && on) ++wrong;   // the ball about it
        near += on ? 1u : 0u;
      }
  CHECK_EQ(wrong, 0u);
  CHECK(near > 100);
}

TEST(Voxels_CubeFillsItsGrid_TetrahedronASixth) {
  const Surface box = cube({3, 4, 5}, 0.5f);
  const VoxelGrid grid = make_voxel_grid({&box}, 10);
  CHECK(grid.count == (std::array<uint32_t, 3>{10, 10, 10}));
  const std::vector<Voxel> voxels = voxelize(box, grid);
  CHECK_EQ(std::count(voxels.begin(), voxels.end(), Voxel::kInside), 8 * 8 * 8);
  CHECK_EQ(std::count(voxels.begin(), voxels.end(), Voxel::kOutside), 0);
  const Surface corner = tetrahedron();
  const VoxelGrid fine = make_voxel_grid({&corner}, 60);
  const std::vector<Voxel> of_corner = voxelize(corner, fine);
  const double share =
      static_cast<double>(std::count(of_corner.begin(), of_corner.end(), Voxel::kInside)) /
      static_cast<double>(fine.voxels());
  CHECK(share > 0.12 && share < 1.0 / 6);
}

TEST(AFlatModelStillHasAVoxelOnEachAxis) {
  Surface flat = cube();
  for (math::Vec3& v : flat.vertices) v.z *= 1e-4f;
  const VoxelGrid grid = make_voxel_grid({&flat}, 16);
  CHECK(grid.count == (std::array<uint32_t, 3>{16, 16, 1}));
  const std::vector<Voxel> voxels = voxelize(flat, grid);
  CHECK_EQ(std::count(voxels.begin(), voxels.end(), Voxel::kSurface), 256);
}

TEST(Flood_AnyVoxelSize_StopsAtTheSurface) {
  const Surface ball = make_part(6, 6000);
  for (const uint32_t cells : {7u, 13u, 29u}) {
    const VoxelGrid grid = make_voxel_grid({&ball}, cells);
    const std::vector<Voxel> voxels = voxelize(ball, grid);
    size_t leaks = 0;
    for (uint32_t z = 0; z < grid.count[2]; ++z)
      for (uint32_t y = 0; y < grid.count[1]; ++y)
        for (uint32_t x = 0; x < grid.count[0]; ++x) {
          const Voxel voxel = voxels[grid.index(x, y, z)];
          if (voxel == Voxel::kSurface) continue;
          const bool inside = winding_by_angles(ball, grid.centre_m(x, y, z)) > 0.5;
          leaks += inside != (voxel == Voxel::kInside) ? 1u : 0u;
          x += 2;  // a third of them will do
        }
    CHECK_EQ(leaks, 0u);
  }
}

}  // namespace firmtouch::tools
