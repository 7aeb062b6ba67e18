#include "lab/paper_figures.hpp"

#include <array>

namespace firmtouch::lab {
namespace {

using tools::Point;
using tools::Surface;

// The three other corners of a pyramid with its apex at the origin, in the order in which its sides
// go round: side k lies between corners k and k + 1.
using Base = std::array<Point, 3>;

// Slender and even.
constexpr Base kEven = {
    {{0.3, 0, -1}, {-0.15, 0.2598076211353316, -1}, {-0.15, -0.2598076211353316, -1}}};

// A wedge: side 0 is upright and wide, the two others lie behind it and lean away.
constexpr Base kWedge = {{{1, 0, -0.8}, {-1, 0, -0.8}, {0, -0.5, -1}}};

Point unit(Point a) { return a * (1 / length(a)); }

// Outside, and nearest to the apex where all weights are positive.
Point query_along(const Base& base, const std::array<double, 3>& weights) {
  Point r;
  for (size_t k = 0; k < 3; ++k) r = r + unit(cross(base[k], base[(k + 1) % 3])) * weights[k];
  return unit(r) * 0.1;
}

// Side 0 in `cuts` + 1 triangles about the apex; the corners that part them are `radius` from it.
Surface cut_pyramid(const Base& base, uint32_t cuts, double radius) {
  Surface surface;
  surface.vertices.push_back({0, 0, 0});
  for (const Point& corner : base) surface.vertices.push_back(to_vec3(corner));
  surface.faces = {{1, 3, 2}, {0, 2, 3}, {0, 3, 1}};
  const Point from = unit(base[0]), to = unit(base[1]);
  const auto inner = [](uint32_t k) { return 4 + k; };
  for (uint32_t k = 0; k < cuts; ++k) {
    const double t = (k + 1.0) / (cuts + 1.0);
    surface.vertices.push_back(to_vec3(unit(from * (1 - t) + to * t) * radius));
    if (k == 0) continue;
    surface.faces.push_back({0, inner(k - 1), inner(k)});
    surface.faces.push_back({k <= cuts / 2 ? 1u : 2u, inner(k), inner(k - 1)});
  }
  surface.faces.push_back({0, 1, inner(0)});
  surface.faces.push_back({0, inner(cuts - 1), 2});
  surface.faces.push_back({1, 2, inner(cuts / 2)});
  return surface;
}

Surface whole_pyramid(const Base& base) {
  Surface surface;
  surface.vertices.push_back({0, 0, 0});
  for (const Point& corner : base) surface.vertices.push_back(to_vec3(corner));
  surface.faces = {{1, 3, 2}, {0, 1, 2}, {0, 2, 3}, {0, 3, 1}};
  return surface;
}

}  // namespace

Surface cut_wedge(uint32_t cuts, double radius) { return cut_pyramid(kWedge, cuts, radius); }

Surface flat_tent(double thickness, double drop) {
  Surface surface;
  for (const Point p :
       {Point{0, 0, 0}, Point{1, 0, 0}, Point{-1, thickness, 0}, Point{0, 1, -drop}})
    surface.vertices.push_back(to_vec3(p));
  surface.faces = {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}};
  return surface;
}

std::vector<PaperFigure> paper_figures() {
  const Point behind = query_along(kWedge, {0.1, 1, 1}), above{0, 0, 0.1};
  return {
      {"figure 2", NormalKind::kMean, cut_wedge(64, 0.6), behind},
      {"figure 3", NormalKind::kGlassnerBall, cut_wedge(64, 0.6), behind},
      {"figure 3, no ball", NormalKind::kGlassner, cut_wedge(256, 0.75), behind},
      {"figure 4", NormalKind::kHuang, whole_pyramid(kEven), query_along(kEven, {0.05, 1, 1})},
      {"figure 5", NormalKind::kMax, cut_wedge(2, 1e-3), behind},
      {"figure 6", NormalKind::kUnitCross, flat_tent(0.02, 0.3), above},
      {"figure 6, not unit", NormalKind::kCross, flat_tent(0.02, 0.3), above},
  };
}

}  // namespace firmtouch::lab
