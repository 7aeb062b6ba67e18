#pragma once
#include <vector>

#include "surface/point.hpp"

namespace firmtouch::tools {

/// Demands normal . x >= offset; the normal is a unit vector.
struct HalfSpace {
  Point normal;
  double offset;
};

enum class Optimum { kFound, kOnBox, kNone };

/// Linear programs in three unknowns: the point of the box |x| <= kBox that lies in all half-spaces
/// and has the least goal . x. The space is meant to be scaled so that the half-spaces come within
/// about 1 of the origin.
/// Bounds: expected O(n) for half-spaces in random order, O(n^3) for the worst one.
/// Result: among several optima one near the origin; kOnBox where only the box holds it; kNone
///         where
///         the half-spaces have nothing in common.
/// Source: Seidel 1991, "Small-dimensional linear programming and convex hulls made easy".
class LinearProgram {
 public:
  static constexpr double kBox = 5;

  Optimum solve(const std::vector<HalfSpace>& spaces, Point goal, Point& x);

 private:
  struct HalfPlane {
    double a, b, offset;  // a s + b t >= offset, (a, b) a unit vector
  };
  bool solve_on_plane(const std::vector<HalfSpace>& spaces, size_t on, Point goal, Point& x);
  bool solve_in_plane(double goal_s, double goal_t, double& s, double& t) const;
  bool solve_on_line(size_t on, double goal_s, double goal_t, double& s, double& t) const;

  std::vector<HalfPlane> planes_;
};

}  // namespace firmtouch::tools
