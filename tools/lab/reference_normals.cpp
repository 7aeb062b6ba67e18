#include "lab/reference_normals.hpp"

#include <cmath>

#include "lab/small_geometry.hpp"

namespace firmtouch::lab {
namespace {

using tools::Point;

Point unit(Point a) {
  const double l = length(a);
  return l > 0 ? a * (1 / l) : Point{};
}

template <class Weight>
Point weighted(const std::vector<Corner>& corners, Weight weight) {
  Point sum;
  for (const Corner& c : corners) sum = sum + unit(cross(c.next, c.last)) * weight(c);
  return sum;
}

Point angle_weighted(const std::vector<Corner>& corners) {
  return weighted(corners, [](const Corner& c) {
    return std::atan2(length(cross(c.next, c.last)), dot(c.next, c.last));
  });
}

// Every edge is the `next` of one corner.
Point fitted(const std::vector<Corner>& corners, bool in_ball) {
  std::vector<Point> neighbours;
  for (const Corner& c : corners) neighbours.push_back(in_ball ? unit(c.next) : c.next);
  const Point normal = normal_of_best_plane(neighbours);
  return dot(normal, angle_weighted(corners)) < 0 ? normal * -1.0 : normal;
}

Point hull_normal(const std::vector<Corner>& corners) {
  std::vector<Point> tips;
  for (const Corner& c : corners) tips.push_back(unit(cross(c.next, c.last)));
  return nearest_of_hull(tips);
}

Point max_along(const std::vector<Corner>& corners, Point r) {
  Point best;
  for (const Corner& c : corners) {
    const Point normal = unit(cross(c.next, c.last));
    if (std::fabs(dot(normal, r)) > std::fabs(dot(best, r))) best = normal;
  }
  return best;
}

}  // namespace

const std::vector<NamedNormal>& reference_normals() {
  static const std::vector<NamedNormal> all = {{NormalKind::kAngleWeighted, "angle-weighted"},
                                               {NormalKind::kConvexHull, "convex hull"},
                                               {NormalKind::kMean, "mean"},
                                               {NormalKind::kGlassner, "Glassner"},
                                               {NormalKind::kGlassnerBall, "Glassner, ball"},
                                               {NormalKind::kHuang, "Huang"},
                                               {NormalKind::kMax, "Max"},
                                               {NormalKind::kMaxAsPrinted, "Max as printed"},
                                               {NormalKind::kUnitCross, "unit cross"},
                                               {NormalKind::kCross, "cross"}};
  return all;
}

std::vector<tools::SideRay> rays_of(const std::vector<Corner>& corners) {
  std::vector<tools::StarEdge> star;
  for (size_t k = 0; k < corners.size(); ++k) {
    const Corner& last = corners[(k + corners.size() - 1) % corners.size()];
    star.push_back({unit(corners[k].next), unit(cross(corners[k].next, corners[k].last)) +
                                               unit(cross(last.next, last.last))});
  }
  return tools::extreme_rays(star);
}

std::vector<std::vector<Corner>> corners_of(const tools::Surface& surface) {
  std::vector<std::vector<Corner>> corners(surface.vertices.size());
  for (const tools::Face& face : surface.faces) {
    for (size_t k = 0; k < 3; ++k) {
      const auto at = [&](size_t i) { return tools::to_point(surface.vertices[face[i % 3]]); };
      corners[face[k]].push_back({at(k + 1) - at(k), at(k + 2) - at(k)});
    }
  }
  return corners;
}

Point reference_normal(NormalKind kind, const std::vector<Corner>& corners, Point r) {
  const auto crossed = [&](const auto& divisor) {
    return weighted(corners,
                    [&](const Corner& c) { return length(cross(c.next, c.last)) / divisor(c); });
  };
  switch (kind) {
    case NormalKind::kAngleWeighted:
      return angle_weighted(corners);
    case NormalKind::kConvexHull:
      return hull_normal(corners);
    case NormalKind::kMean:
      return weighted(corners, [](const Corner&) { return 1.0; });
    case NormalKind::kGlassner:
      return fitted(corners, false);
    case NormalKind::kGlassnerBall:
      return fitted(corners, true);
    case NormalKind::kHuang:
      return max_along(corners, r);
    case NormalKind::kMax:
      return crossed([](const Corner& c) { return dot(c.next, c.next) * dot(c.last, c.last); });
    case NormalKind::kMaxAsPrinted:
      return crossed([](const Corner& c) { return dot(c.next, c.next) + dot(c.last, c.last); });
    case NormalKind::kUnitCross:
      return crossed([](const Corner& c) { return length(c.next) * length(c.last); });
    case NormalKind::kCross:
      return crossed([](const Corner&) { return 1.0; });
  }
  return {};
}

}  // namespace firmtouch::lab
