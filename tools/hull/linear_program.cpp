#include "hull/linear_program.hpp"

#include <algorithm>

namespace firmtouch::tools {
namespace {

// In a space scaled to 1, far above the rounding of doubles. What they let pass below a plane, the
// exact check of the rounded vertex refuses.
constexpr double kFeasible = 1e-12;
constexpr double kParallel = 1e-13;
constexpr double kSlack = 1e-11;
constexpr double kNoGoal = 1e-15;
constexpr double kPlaneBox = 20;  // holds all of a plane that the box holds

double start_of(double goal, double box) {
  return goal > kNoGoal ? -box : goal < -kNoGoal ? box : 0;
}

double coordinate(Point p, int k) { return k == 0 ? p.x : k == 1 ? p.y : p.z; }

Point axis(int k) { return {k == 0 ? 1.0 : 0.0, k == 1 ? 1.0 : 0.0, k == 2 ? 1.0 : 0.0}; }

// A unit vector across n.
Point across(Point n) {
  const double x = std::fabs(n.x), y = std::fabs(n.y), z = std::fabs(n.z);
  const Point other = cross(n, axis(x <= y && x <= z ? 0 : y <= z ? 1 : 2));
  return other * (1 / length(other));
}

}  // namespace

Optimum LinearProgram::solve(const std::vector<HalfSpace>& spaces, Point goal, Point& x) {
  x = {start_of(goal.x, kBox), start_of(goal.y, kBox), start_of(goal.z, kBox)};
  for (size_t i = 0; i < spaces.size(); ++i) {
    if (dot(spaces[i].normal, x) >= spaces[i].offset - kFeasible) continue;
    if (!solve_on_plane(spaces, i, goal, x)) return Optimum::kNone;
  }
  for (int k = 0; k < 3; ++k) {
    if (std::fabs(coordinate(x, k)) >= kBox - kSlack) return Optimum::kOnBox;
  }
  return Optimum::kFound;
}

// The optimum lies on the plane of half-space `on`: those before it and the box, cut with it.
bool LinearProgram::solve_on_plane(const std::vector<HalfSpace>& spaces, size_t on, Point goal,
                                   Point& x) {
  const Point n = spaces[on].normal, foot = n * spaces[on].offset;
  const Point e = across(n), f = cross(n, e);
  planes_.clear();
  const auto cut = [&](Point normal, double offset) {
    const double a = dot(normal, e), b = dot(normal, f), rest = offset - dot(normal, foot);
    const double size = std::sqrt(a * a + b * b);
    if (size < kParallel) return rest <= kSlack;
    planes_.push_back({a / size, b / size, rest / size});
    return true;
  };
  for (int k = 0; k < 3; ++k) {
    if (!cut(axis(k), -kBox) || !cut(axis(k) * -1.0, -kBox)) return false;
  }
  for (size_t j = 0; j < on; ++j) {
    if (!cut(spaces[j].normal, spaces[j].offset)) return false;
  }
  double s = 0, t = 0;
  if (!solve_in_plane(dot(goal, e), dot(goal, f), s, t)) return false;
  x = foot + e * s + f * t;
  return true;
}

bool LinearProgram::solve_in_plane(double goal_s, double goal_t, double& s, double& t) const {
  s = start_of(goal_s, kPlaneBox);
  t = start_of(goal_t, kPlaneBox);
  for (size_t i = 0; i < planes_.size(); ++i) {
    const HalfPlane& plane = planes_[i];
    if (plane.a * s + plane.b * t >= plane.offset - kFeasible) continue;
    if (!solve_on_line(i, goal_s, goal_t, s, t)) return false;
  }
  return true;
}

// Along the line: (a, b) offset + (-b, a) u.
bool LinearProgram::solve_on_line(size_t on, double goal_s, double goal_t, double& s,
                                  double& t) const {
  const HalfPlane& line = planes_[on];
  double low = -2 * kPlaneBox, high = 2 * kPlaneBox;
  for (size_t j = 0; j < on; ++j) {
    const HalfPlane& other = planes_[j];
    const double slope = other.b * line.a - other.a * line.b;
    const double rest = other.offset - line.offset * (other.a * line.a + other.b * line.b);
    if (std::fabs(slope) < kParallel) {
      if (rest > kSlack) return false;
    } else if (slope > 0) {
      low = std::max(low, rest / slope);
    } else {
      high = std::min(high, rest / slope);
    }
  }
  if (low > high + kSlack) return false;
  if (low > high) low = high = 0.5 * (low + high);
  const double goal = goal_t * line.a - goal_s * line.b;
  const double u = goal > kNoGoal ? low : goal < -kNoGoal ? high : std::clamp(0.0, low, high);
  s = line.a * line.offset - line.b * u;
  t = line.b * line.offset + line.a * u;
  return true;
}

}  // namespace firmtouch::tools
