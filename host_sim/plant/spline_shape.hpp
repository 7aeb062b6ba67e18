#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "firmtouch/spline/view.hpp"
#include "host_sim/plant/vec.hpp"

namespace firmtouch::host_sim {

/// A point of a stored piece, s and t from -1 to 1, in double.
Vec spline_point(const spline::View& model, uint32_t piece, double s, double t);

/// Distance of the nearest point by dense samples and refinement from the best of them: a judge that
/// shares nothing with the search.
double spline_distance_m(const spline::View& surface, Vec p_m);

/// Triangles over the pieces: to be drawn, and to find out what they bound.
struct Shell {
  std::vector<Vec> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
};
Shell shell_of(const spline::View& surface);

/// How a hand is to take the surfaces: whether they enclose a space, and whether their normals point
/// into it.
struct Sides {
  bool is_closed = false;
  bool is_turned = false;
};
Sides sides_of(const Shell& shell);

}  // namespace firmtouch::host_sim
