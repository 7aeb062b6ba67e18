#include "hull/progressive_hull.hpp"

#include <algorithm>

#include "surface/edges.hpp"

namespace firmtouch::tools {
namespace {

// So much of the largest extent is free on each side, at least.
constexpr double kFree = 0.125;

struct Range {
  double low, high;
};

Range range_of(const Surface& surface, int k) {
  const auto value = [k](const math::Vec3& v) {
    return static_cast<double>(k == 0 ? v.x : k == 1 ? v.y : v.z);
  };
  Range range{value(surface.vertices[0]), value(surface.vertices[0])};
  for (const math::Vec3& v : surface.vertices) {
    range.low = std::min(range.low, value(v));
    range.high = std::max(range.high, value(v));
  }
  return range;
}

bool snap_one(double low, double cell, double last, double value, float& snapped) {
  const double steps = std::floor((value - low) / cell + 0.5);
  if (!(steps >= 0 && steps <= last)) return false;
  snapped = static_cast<float>(low + steps * cell);
  return true;
}

}  // namespace

bool HullGrid::snap(Point p, math::Vec3& q) const {
  const double last = static_cast<double>((uint64_t{1} << bits) - 1);
  return snap_one(low_m.x, cell_m, last, p.x, q.x) && snap_one(low_m.y, cell_m, last, p.y, q.y) &&
         snap_one(low_m.z, cell_m, last, p.z, q.z);
}

HullGrid grid_for(const Surface& surface, uint32_t bits) {
  const Range sides[3] = {range_of(surface, 0), range_of(surface, 1), range_of(surface, 2)};
  double extent = 0, farthest = 0;
  for (const Range& side : sides) {
    extent = std::max(extent, side.high - side.low);
    farthest = std::max({farthest, std::fabs(side.low), std::fabs(side.high)});
  }
  HullGrid grid;
  grid.bits = bits;
  const double steps = static_cast<double>(uint64_t{1} << bits);
  // Of the second: every grid point is a whole number of at most 24 bits, times the cell.
  const auto is_wide_enough = [&](double cell) {
    return cell * (steps - 2) >= (1 + 2 * kFree) * extent &&
           cell * (0x1p24 - steps * 0.5 - 2) >= farthest;
  };
  grid.cell_m = 1;
  while (!is_wide_enough(grid.cell_m)) grid.cell_m *= 2;
  while (is_wide_enough(grid.cell_m * 0.5)) grid.cell_m *= 0.5;
  const auto low = [&](const Range& side) {
    const double middle = std::floor((side.low + side.high) * 0.5 / grid.cell_m);
    return (middle - steps * 0.5) * grid.cell_m;
  };
  grid.low_m = {low(sides[0]), low(sides[1]), low(sides[2])};
  return grid;
}

Surface hull_after(const ProgressiveHull& hull, uint32_t collapses) {
  Surface level;
  level.vertices.assign(hull.vertices_m.begin(),
                        hull.vertices_m.begin() + hull.mesh_vertices + collapses);
  // Where each vertex has gone: later ones first, so that one step each is enough.
  std::vector<uint32_t> stands_for(level.vertices.size());
  for (uint32_t v = static_cast<uint32_t>(stands_for.size()); v-- > 0;) {
    const uint32_t by = hull.removed_by[v];
    stands_for[v] = by == kNone || by >= collapses ? v : stands_for[hull.mesh_vertices + by];
  }
  for (uint32_t f = 0; f < hull.mesh_faces.size(); ++f) {
    const Face& face = hull.mesh_faces[f];
    const Face moved{stands_for[face[0]], stands_for[face[1]], stands_for[face[2]]};
    if (moved[0] == moved[1] || moved[1] == moved[2] || moved[2] == moved[0]) continue;
    level.faces.push_back(moved);
    level.source.push_back(f);
  }
  return level;
}

Surface hull_level(const ProgressiveHull& hull, uint32_t faces) {
  const uint32_t all = static_cast<uint32_t>(hull.mesh_faces.size());
  const uint32_t wanted = faces >= all ? 0 : (all - faces + 1) / 2;
  Surface level = hull_after(hull, std::min(wanted, static_cast<uint32_t>(hull.collapses.size())));
  std::vector<uint32_t> number(level.vertices.size(), kNone);
  for (const Face& face : level.faces) {
    for (const uint32_t corner : face) number[corner] = 0;
  }
  std::vector<math::Vec3> used;
  for (uint32_t v = 0; v < number.size(); ++v) {
    if (number[v] == kNone) continue;
    number[v] = static_cast<uint32_t>(used.size());
    used.push_back(level.vertices[v]);
  }
  for (Face& face : level.faces) face = {number[face[0]], number[face[1]], number[face[2]]};
  level.vertices = std::move(used);
  return level;
}

double enclosed_volume_m3(const Surface& surface) {
  if (surface.faces.empty()) return 0;
  const Point origin = to_point(surface.vertices[surface.faces[0][0]]);
  double sum = 0;
  for (const Face& face : surface.faces) {
    const Point a = to_point(surface.vertices[face[0]]) - origin,
                b = to_point(surface.vertices[face[1]]) - origin,
                c = to_point(surface.vertices[face[2]]) - origin;
    sum += dot(a, cross(b, c));
  }
  return sum / 6;
}

}  // namespace firmtouch::tools
