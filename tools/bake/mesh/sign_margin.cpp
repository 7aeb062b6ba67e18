#include "bake/mesh/sign_margin.hpp"

#include <algorithm>
#include <utility>

namespace firmtouch::tools {
namespace {

// Edges less askew than this are taken for one line; gaps short of a half turn by this and by the
// rounding of what bounds them are taken for a half turn.
constexpr double kOneLine = 1e-13, kGapSlack = 1e-12, kRounding = 1e-15;
// The cone of so many edges takes no selection; of more the selection ends at kMaxEdges.
constexpr size_t kFewEdges = 64, kMaxEdges = 1000;
// Sine by which a ray may be in front of an edge that was not selected.
constexpr double kInFront = 1e-12;

// Grows with the angle from 0 to 4; a half turn is 2 everywhere. No arc tangent: what is chosen by
// it goes into assets, and must be the same on every machine.
double turn_of(double x, double y) {
  const double part = y / (std::fabs(x) + std::fabs(y));
  return x < 0 ? 2 - part : y < 0 ? 4 + part : part;
}

// A unit vector square to `e`.
Point square_to(Point e) {
  const Point axis = std::fabs(e.x) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
  const Point across = cross(e, axis);
  return across * (1 / length(across));
}

std::vector<SideRay> rays_of(const std::vector<StarEdge>& star) {
  struct Bar {
    double turn, x, y;  // of an edge, seen along the edge at hand
    double doubt;       // of its turn
  };
  std::vector<SideRay> rays;
  std::vector<Bar> bars;
  for (const StarEdge& edge : star) {
    const Point right = square_to(edge.direction), up = cross(edge.direction, right);
    bars.clear();
    for (const StarEdge& other : star) {
      const double x = dot(other.direction, right), y = dot(other.direction, up);
      if (x * x + y * y > kOneLine * kOneLine)
        bars.push_back({turn_of(x, y), x, y, kRounding / std::sqrt(x * x + y * y)});
    }
    std::sort(bars.begin(), bars.end(), [](const Bar& a, const Bar& b) { return a.turn < b.turn; });
    // A ray from which all bars point away stands a quarter turn beyond both ends of a gap of at
    // least a half turn between them.
    for (size_t i = 0; i < bars.size(); ++i) {
      const bool is_last = i + 1 == bars.size();
      const Bar &from = bars[i], &to = bars[is_last ? 0 : i + 1];
      if (to.turn + (is_last ? 4 : 0) - from.turn < 2 - kGapSlack - from.doubt - to.doubt) continue;
      for (const auto& [x, y] : {std::pair{-from.y, from.x}, std::pair{to.y, -to.x}}) {
        const Point ray = (right * x + up * y) * (1 / std::sqrt(x * x + y * y));
        rays.push_back({ray, dot(edge.normal, ray) < 0 ? -1 : 1});
      }
    }
  }
  return rays;
}

// The edge that is most askew to the first.
size_t most_askew(const std::vector<StarEdge>& star) {
  const auto it = std::max_element(star.begin(), star.end(), [&](const auto& a, const auto& b) {
    return length(cross(a.direction, star[0].direction)) <
           length(cross(b.direction, star[0].direction));
  });
  return static_cast<size_t>(it - star.begin());
}

// Selects the edge that is farthest beyond each ray. Result: whether there were any.
bool select_beyond(const std::vector<SideRay>& rays, const std::vector<StarEdge>& whole,
                   std::vector<bool>& is_selected) {
  bool is_any = false;
  for (const SideRay& ray : rays) {
    double farthest = kInFront;
    size_t at = whole.size();
    for (size_t k = 0; k < whole.size(); ++k) {
      const double beyond = dot(whole[k].direction, ray.direction);
      if (beyond > farthest) farthest = beyond, at = k;
    }
    if (at == whole.size() || is_selected[at]) continue;
    is_selected[at] = is_any = true;
  }
  return is_any;
}

}  // namespace

// The cone of some edges is too wide where a ray of it is beyond another edge: that edge is then
// selected, too. So a fan in a flat face, of any number of edges, needs few of them.
std::vector<SideRay> extreme_rays(const std::vector<StarEdge>& whole) {
  if (whole.size() <= kFewEdges) return rays_of(whole);
  std::vector<bool> is_selected(whole.size());
  const size_t step = (whole.size() + kFewEdges - 1) / kFewEdges;
  for (size_t k = 0; k < whole.size(); k += step) is_selected[k] = true;
  // Edges of one line have no rays.
  is_selected[most_askew(whole)] = true;
  for (;;) {
    std::vector<StarEdge> star;
    for (size_t k = 0; k < whole.size(); ++k)
      if (is_selected[k]) star.push_back(whole[k]);
    const std::vector<SideRay> rays = rays_of(star);
    if (star.size() > kMaxEdges || !select_beyond(rays, whole, is_selected)) return rays;
  }
}

double vertex_margin(const std::vector<SideRay>& rays, Point normal) {
  double least = 1;
  for (const SideRay& ray : rays) {
    const double height = ray.side * dot(normal, ray.direction);
    if (!(height >= -1.5)) return -1;  // NaN
    least = std::min(least, height);
  }
  return least;
}

double edge_margin(Point one, Point other, Point normal) {
  const double a = dot(normal, one), b = dot(normal, other);
  return a >= -1.5 && b >= -1.5 ? std::min(a, b) : -1;
}

}  // namespace firmtouch::tools
