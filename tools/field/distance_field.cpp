#include "field/distance_field.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "batch/parallel.hpp"
#include "field/block_search.hpp"

namespace firmtouch::tools {
namespace {

constexpr uint32_t kBlock = 8;        // voxels a side; halved twice on the way to a voxel
constexpr size_t kBlocksAChunk = 16;  // with the same lists

using Clock = std::chrono::steady_clock;
double since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

size_t chunks(size_t items, size_t a_chunk) { return (items + a_chunk - 1) / a_chunk; }

std::array<Point, 3> corners_of(const Surface& surface, uint32_t face) {
  const Face& f = surface.faces[face];
  return {to_point(surface.vertices[f[0]]), to_point(surface.vertices[f[1]]),
          to_point(surface.vertices[f[2]])};
}

// What the nearest triangle says, in double.
Nearest reported_by(const Solid& solid, uint32_t triangle, Point p, uint16_t object) {
  Nearest nearest;
  nearest.face = solid.tree.face_of(triangle);
  const Foot foot = foot_on(p, corners_of(solid.surface, nearest.face));
  nearest.sign = static_cast<int8_t>(solid.sides.side_of(p, nearest.face, foot));
  nearest.distance_m = static_cast<float>(nearest.sign * std::sqrt(foot.distance2));
  nearest.closest_m = to_vec3(foot.at);
  nearest.object = object;
  return nearest;
}

// Nearest of both; inside where either is.
void join(Nearest& to, const Nearest& more) {
  if (to.sign == 0) {
    to = more;
    return;
  }
  const int8_t sign = std::min(to.sign, more.sign);
  if (std::fabs(more.distance_m) < std::fabs(to.distance_m)) to = more;
  to.sign = sign;
  to.distance_m = sign < 0 ? -std::fabs(to.distance_m) : std::fabs(to.distance_m);
}

// The blocks of one solid, one after another.
class BlockWork {
 public:
  BlockWork(const Solid& solid, uint16_t object, DistanceField& distance_field,
            const std::vector<bool>& wanted, std::vector<int8_t>& own_sign)
      : solid_(solid),
        object_(object),
        field_(distance_field),
        wanted_(wanted),
        own_sign_(own_sign),
        search_(solid.tree) {}

  void operator()(size_t block) {
    const auto& count = field_.grid.count;
    const uint32_t nx = blocks(count[0]), ny = blocks(count[1]);
    const Cube whole{static_cast<uint32_t>(block % nx) * kBlock,
                     static_cast<uint32_t>(block / nx % ny) * kBlock,
                     static_cast<uint32_t>(block / nx / ny) * kBlock, kBlock};
    if (!any_wanted(whole)) return;
    search_.seed = kNoFace;  // what a block gives depends on nothing but the block
    const Bounds bounds = bounds_of(whole);
    search_.open_block(bounds.low, bounds.high, of_block_);
    for (uint32_t half = 0; half < 8; ++half) {
      const Cube cube = child(whole, half);
      if (!any_wanted(cube)) continue;
      const Bounds in = bounds_of(cube);
      search_.narrow(of_block_, in.low, in.high, of_cube_);
      for (uint32_t quarter = 0; quarter < 8; ++quarter) {
        const Cube small = child(cube, quarter);
        if (!any_wanted(small)) continue;
        const Bounds inner = bounds_of(small);
        search_.narrow(of_cube_, inner.low, inner.high, of_small_);
        answer(small);
      }
    }
  }

  static uint32_t blocks(uint32_t voxels) { return (voxels + kBlock - 1) / kBlock; }

 private:
  struct Cube {
    uint32_t x, y, z, side;
  };
  struct Bounds {
    std::array<float, 3> low, high;
  };

  static Cube child(const Cube& of, uint32_t which) {
    const uint32_t half = of.side / 2;
    return {of.x + (which & 1u) * half, of.y + (which >> 1 & 1u) * half, of.z + (which >> 2) * half,
            half};
  }

  template <class Visit>
  void each(const Cube& cube, const Visit& visit) const {
    const auto& count = field_.grid.count;
    for (uint32_t z = cube.z; z < std::min(cube.z + cube.side, count[2]); ++z)
      for (uint32_t y = cube.y; y < std::min(cube.y + cube.side, count[1]); ++y)
        for (uint32_t x = cube.x; x < std::min(cube.x + cube.side, count[0]); ++x)
          if (wanted_[field_.grid.index(x, y, z)] && visit(x, y, z)) return;
  }

  bool any_wanted(const Cube& cube) const {
    bool any = false;
    each(cube, [&](uint32_t, uint32_t, uint32_t) { return any = true; });
    return any;
  }

  // Of the centres of its voxels.
  Bounds bounds_of(const Cube& cube) const {
    const double more = cube.side - 1.0;
    return {solid_.tree.local(field_.grid.centre_m(cube.x, cube.y, cube.z)),
            solid_.tree.local(field_.grid.centre_m(cube.x + more, cube.y + more, cube.z + more))};
  }

  void answer(const Cube& cube) {
    each(cube, [&](uint32_t x, uint32_t y, uint32_t z) {
      const Point p = field_.grid.centre_m(x, y, z);
      const uint32_t triangle = search_.nearest(of_small_, solid_.tree.local(p));
      const Nearest nearest = reported_by(solid_, triangle, p, object_);
      const size_t voxel = field_.grid.index(x, y, z);
      own_sign_[voxel] = nearest.sign;
      join(field_.values[voxel], nearest);
      return false;
    });
  }

  const Solid& solid_;
  uint16_t object_;
  DistanceField& field_;
  const std::vector<bool>& wanted_;
  std::vector<int8_t>& own_sign_;
  BlockSearch search_;
  BoxList of_block_, of_cube_;
  DiskList of_small_;
};

void compare(const std::vector<Voxel>& flood, const std::vector<int8_t>& signs, uint16_t object,
             DistanceField& distance_field) {
  for (size_t v = 0; v < flood.size(); ++v) {
    if (flood[v] == Voxel::kSurface || signs[v] == 0) continue;
    const bool is_inside = flood[v] == Voxel::kInside;
    if (is_inside != (signs[v] < 0)) distance_field.disagreements.push_back({v, object, is_inside});
  }
}

void join_kinds(std::vector<Voxel>& to, const std::vector<Voxel>& more) {
  for (size_t v = 0; v < to.size(); ++v) to[v] = std::max(to[v], more[v]);
}

}  // namespace

DistanceField make_distance_field(const std::vector<Solid>& solids, const VoxelGrid& grid,
                                  const FieldOptions& options) {
  DistanceField distance_field;
  distance_field.grid = grid;
  const auto begin = Clock::now();
  std::vector<std::vector<Voxel>> floods;
  for (const Solid& solid : solids) floods.push_back(voxelize(solid.surface, grid));
  distance_field.kinds = floods[0];
  for (const auto& flood : floods) join_kinds(distance_field.kinds, flood);
  std::vector<bool> wanted(grid.voxels(), true);
  for (size_t v = 0; v < wanted.size(); ++v) {
    size_t& counter = distance_field.kinds[v] == Voxel::kOutside   ? distance_field.outside
                      : distance_field.kinds[v] == Voxel::kSurface ? distance_field.surface
                                                                   : distance_field.inside;
    ++counter;
    if (options.interior_only && distance_field.kinds[v] == Voxel::kOutside) wanted[v] = false;
  }
  distance_field.computed =
      options.interior_only ? distance_field.surface + distance_field.inside : wanted.size();
  distance_field.voxelize_s = since(begin);

  const auto middle = Clock::now();
  distance_field.values.resize(wanted.size());
  const size_t blocks = size_t{BlockWork::blocks(grid.count[0])} *
                        BlockWork::blocks(grid.count[1]) * BlockWork::blocks(grid.count[2]);
  for (size_t s = 0; s < solids.size(); ++s) {
    std::vector<int8_t> own_sign(wanted.size(), 0);
    in_parallel(
        chunks(blocks, kBlocksAChunk), options.threads,
        [&](uint64_t chunk) {
          BlockWork work(solids[s], static_cast<uint16_t>(s), distance_field, wanted, own_sign);
          const size_t first = chunk * kBlocksAChunk, end = std::min(first + kBlocksAChunk, blocks);
          for (size_t block = first; block < end; ++block) work(block);
        },
        [&](double share) {
          if (options.on_progress)
            options.on_progress((static_cast<double>(s) + share) /
                                static_cast<double>(solids.size()));
        });
    compare(floods[s], own_sign, static_cast<uint16_t>(s), distance_field);
  }
  distance_field.distance_s = since(middle);
  return distance_field;
}

}  // namespace firmtouch::tools
