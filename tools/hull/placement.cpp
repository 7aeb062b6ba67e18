#include "hull/placement.hpp"

#include <algorithm>
#include <utility>

#include "surface/exact_side.hpp"
#include "surface/random.hpp"
#include "surface/turns.hpp"

namespace firmtouch::tools {
namespace {

// 1 for an equilateral triangle, 0 for one without area. Source: Gueziec 1999.
double compactness_of(Point a, Point b, Point c) {
  const Point ab = b - a, bc = c - b, ca = a - c;
  const double sides2 = dot(ab, ab) + dot(bc, bc) + dot(ca, ca);
  return sides2 > 0 ? 2 * 1.7320508075688772 * length(cross(ab, ca)) / sides2 : 0;
}

}  // namespace

Placement::Placement(const CollapseMesh& mesh, const HullGrid& grid, const HullLimits& limits,
                     HullCounts& counts)
    : mesh_(mesh),
      grid_(grid),
      limits_(limits),
      min_cosine_(cosine_of_turns(limits.max_deviation_deg / 360)),
      counts_(counts) {}

bool Placement::may_collapse(uint32_t edge) {
  ++counts_.evaluations;
  // The paper says "the edge's valence" and aims at vertices: the valence that the new one has.
  if (mesh_.crowd_of(edge) > limits_.max_valence + 4) {
    ++counts_.valence;
    return false;
  }
  if (mesh_.star_of(edge, star_)) return true;
  ++counts_.link;
  return false;
}

bool Placement::place(math::Vec3& at_m, double& volume_m3) {
  Point x_m;
  if (!solve(x_m)) return false;
  if (limits_.is_careless) {
    at_m = to_vec3(x_m);
  } else if (!grid_.snap(x_m, at_m)) {
    ++counts_.off_grid;
    return false;
  } else if (!is_outside(at_m)) {
    ++counts_.not_outside;
    return false;
  }
  volume_m3 = 0;
  for (uint32_t i = 0; i < star_.face_count(); ++i) {
    const Face face = star_.face(i);
    const Point a = at(face[0]);
    volume_m3 += dot(cross(at(face[1]) - a, at(face[2]) - a), to_point(at_m) - a) / 6;
  }
  return keeps_shape(to_point(at_m));
}

// Scaled by the star's radius about the middle of the edge.
bool Placement::solve(Point& x_m) {
  const Point middle = (at(star_.u) + at(star_.v)) * 0.5;
  double radius2 = 0;
  for (const uint32_t vertex : star_.link) {
    const Point d = at(vertex) - middle;
    radius2 = std::max(radius2, dot(d, d));
  }
  const double radius = std::sqrt(radius2), half = limits_.is_careless ? 0 : 0.5 * grid_.cell_m;
  spaces_.clear();
  Point goal;
  for (uint32_t i = 0; i < star_.face_count(); ++i) {
    const Face face = star_.face(i);
    const Point a = at(face[0]);
    const Point across = cross(at(face[1]) - a, at(face[2]) - a);
    const double size = length(across);
    if (!(size > 0)) continue;
    const Point n = across * (1 / size);
    const double lift = half * (std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z));
    spaces_.push_back({n, (dot(n, a - middle) + lift) / radius});
    goal = goal + across;
  }
  const double size = length(goal);
  if (!(size > 0)) return false;
  Random random((uint64_t{star_.u} << 32) | star_.v);
  for (uint32_t i = static_cast<uint32_t>(spaces_.size()); i > 1; --i) {
    std::swap(spaces_[i - 1], spaces_[random.below(i)]);
  }
  ++counts_.programs;
  Point x;
  const Optimum found = program_.solve(spaces_, goal * (1 / size), x);
  if (found == Optimum::kNone) ++counts_.unsolvable;
  if (found == Optimum::kOnBox) ++counts_.on_box;
  x_m = middle + x * radius;
  return found != Optimum::kNone;
}

bool Placement::is_outside(math::Vec3 at_m) const {
  const std::vector<math::Vec3>& vertices = mesh_.vertices();
  for (uint32_t i = 0; i < star_.face_count(); ++i) {
    const Face face = star_.face(i);
    if (exact_side(vertices[face[0]], vertices[face[1]], vertices[face[2]], at_m) < 0) return false;
  }
  return true;
}

bool Placement::keeps_shape(Point to) {
  double before = 1, after = 1;
  for (uint32_t i = 0; i < star_.face_count(); ++i) {
    const Face face = star_.face(i);
    const Point a = at(face[0]), b = at(face[1]), c = at(face[2]);
    before = std::min(before, compactness_of(a, b, c));
    if (i >= star_.link.size()) continue;
    after = std::min(after, compactness_of(to, b, c));
    const Point old_normal = cross(b - a, c - a), new_normal = cross(b - to, c - to);
    const double most = length(old_normal) * length(new_normal);
    if (!(dot(old_normal, new_normal) >= min_cosine_ * most && most > 0)) {
      ++counts_.deviation;
      return false;
    }
  }
  if (after > limits_.compactness * before) return true;
  ++counts_.compactness;
  return false;
}

double Placement::centre_volume_m3() const {
  Point sum;
  for (const uint32_t vertex : star_.link) sum = sum + at(vertex);
  const Point centre = sum * (1.0 / static_cast<double>(star_.link.size()));
  double volume = 0;
  for (uint32_t i = 0; i < star_.face_count(); ++i) {
    const Face face = star_.face(i);
    const Point a = at(face[0]);
    volume += std::fabs(dot(cross(at(face[1]) - a, at(face[2]) - a), centre - a)) / 6;
  }
  return volume;
}

}  // namespace firmtouch::tools
