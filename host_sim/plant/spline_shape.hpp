#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "firmtouch/spline/view.hpp"
#include "host_sim/plant/vec.hpp"

namespace firmtouch::host_sim {

/// Point of a stored piece at (s, t), both in [-1, 1], in double.
Vec spline_point(const spline::View& model, uint32_t piece, double s, double t);

/// Distance of `p_m` to the surface: dense sampling, then refinement of the six best samples.
/// An oracle for the controller's answers; shares no code with its search.
double spline_distance_m(const spline::View& surface, Vec p_m);

/// Triangles that approximate the pieces, for drawing and for winding numbers.
struct Tessellation {
  std::vector<Vec> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
};
Tessellation tessellate(const spline::View& surface);

/// Whether the surfaces enclose a volume, and whether their normals point into it.
struct Orientation {
  bool is_closed = false;
  bool normals_inward = false;
};
Orientation orientation_of(const Tessellation& tessellation);

}  // namespace firmtouch::host_sim
