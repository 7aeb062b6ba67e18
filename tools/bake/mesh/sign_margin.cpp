#include "bake/mesh/sign_margin.hpp"

#include <algorithm>
#include <utility>

namespace firmtouch::tools {
namespace {

// Edges less askew than this are taken for one line; gaps short of a half turn by this and by the
// rounding of what bounds them are taken for a half turn.
constexpr double kOneLine = 1e-13, kGapSlack = 1e-12, kRounding = 1e-15;
constexpr size_t kMaxEdges = 1000;

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

// Every k-th edge, so that the tip of a finely cut cone takes no hours. Fewer edges leave a wider
// cone: the margin is never reported too large.
std::vector<StarEdge> thinned(const std::vector<StarEdge>& star) {
  std::vector<StarEdge> few;
  const size_t step = (star.size() + kMaxEdges - 1) / kMaxEdges;
  for (size_t k = 0; k < star.size(); k += step) few.push_back(star[k]);
  return few;
}

}  // namespace

std::vector<SideRay> extreme_rays(const std::vector<StarEdge>& whole) {
  struct Bar {
    double turn, x, y;  // of an edge, seen along the edge at hand
    double doubt;       // of its turn
  };
  std::vector<SideRay> rays;
  std::vector<Bar> bars;
  const std::vector<StarEdge> star = whole.size() > kMaxEdges ? thinned(whole) : whole;
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
