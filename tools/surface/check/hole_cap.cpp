#include "surface/check/hole_cap.hpp"

#include <algorithm>
#include <limits>

#include "surface/point.hpp"

namespace firmtouch::tools {
namespace {

// A triangle lower than this share of its longest edge is a sliver.
constexpr double kMinHeight = 1e-4;
// Two faces whose normals' cosine is below this lie on one another (2.6 degrees).
constexpr double kFoldedBack = -0.999;

// How good a part of a cap is: less is better. `bend` is 1 minus the least cosine between
// neighbours.
struct Cost {
  double bend = std::numeric_limits<double>::infinity();
  double area = std::numeric_limits<double>::infinity();
};

bool is_possible(const Cost& cost) { return cost.area < std::numeric_limits<double>::infinity(); }

// The triangulation of the border's vertices i to j for every i < j, from that of shorter parts.
class Caps {
 public:
  Caps(const Surface& surface, const Hole& hole,
       const std::vector<std::pair<uint32_t, uint32_t>>& taken, CapRule rule)
      : hole_(hole), taken_(taken), rule_(rule), count_(hole.border.size()) {
    for (const uint32_t v : hole.border) at_.push_back(to_point(surface.vertices[v]));
    for (size_t k = 0; k < count_; ++k) {
      const Point a = at_[k], b = at_[(k + 1) % count_];
      beyond_.push_back(unit_normal(b, a, to_point(surface.vertices[hole.beyond[k]])));
    }
    cost_.resize(count_ * count_);
    tip_.resize(count_ * count_, 0);
  }

  std::vector<Face> best() {
    for (size_t i = 0; i + 1 < count_; ++i) cost_[i * count_ + i + 1] = {0, 0};
    for (size_t span = 2; span < count_; ++span)
      for (size_t i = 0; i + span < count_; ++i) choose_tip(i, i + span);
    std::vector<Face> faces;
    if (!is_possible(cost_[count_ - 1])) return faces;
    std::vector<std::pair<size_t, size_t>> parts{{0, count_ - 1}};
    while (!parts.empty()) {
      const auto [i, j] = parts.back();
      parts.pop_back();
      if (j - i < 2) continue;
      const size_t m = tip_[i * count_ + j];
      faces.push_back({hole_.border[i], hole_.border[m], hole_.border[j]});
      parts.push_back({m, j});
      parts.push_back({i, m});
    }
    return faces;
  }

 private:
  static Point unit_normal(Point a, Point b, Point c) {
    const Point normal = cross(b - a, c - a);
    const double size = length(normal);
    return size > 0 ? normal * (1 / size) : Point{};
  }

  // The normal on the other side of the line from i to j: of the part i..j, or of the surface.
  Point normal_of(size_t i, size_t j) const {
    return j == i + 1 ? beyond_[i] : unit_normal(at_[i], at_[tip_[i * count_ + j]], at_[j]);
  }

  // The diagonal from i to j becomes an edge of the cap: the surface must not have it yet.
  bool is_free(size_t i, size_t j) const {
    const uint32_t a = hole_.border[i], b = hole_.border[j];
    return !std::binary_search(taken_.begin(), taken_.end(),
                               std::pair{std::min(a, b), std::max(a, b)});
  }

  bool is_less(const Cost& a, const Cost& b) const {
    if (rule_ == CapRule::kMinArea) return a.area < b.area;
    return a.bend < b.bend || (!(b.bend < a.bend) && a.area < b.area);
  }

  void choose_tip(size_t i, size_t j) {
    const bool is_whole = i == 0 && j + 1 == count_;
    if (!is_whole && !is_free(i, j)) return;
    Cost& best = cost_[i * count_ + j];
    for (size_t m = i + 1; m < j; ++m) {
      const Cost &left = cost_[i * count_ + m], &right = cost_[m * count_ + j];
      if (!is_possible(left) || !is_possible(right)) continue;
      const Cost cost = joined(i, m, j, left, right, is_whole);
      if (!is_less(cost, best) || !is_possible(cost)) continue;
      best = cost;
      tip_[i * count_ + j] = static_cast<uint32_t>(m);
    }
  }

  Cost joined(size_t i, size_t m, size_t j, const Cost& left, const Cost& right,
              bool is_whole) const {
    const Point a = at_[i], b = at_[m], c = at_[j];
    const Point normal = cross(b - a, c - a);
    const double doubled = length(normal);
    const double longest2 = std::max({dot(b - a, b - a), dot(c - b, c - b), dot(a - c, a - c)});
    if (!(doubled > kMinHeight * longest2)) return {};
    const Point unit = normal * (1 / doubled);
    double cosine = std::min(dot(unit, normal_of(i, m)), dot(unit, normal_of(m, j)));
    if (is_whole) cosine = std::min(cosine, dot(unit, beyond_[j]));
    if (!(cosine > kFoldedBack)) return {};
    return {std::max({1 - cosine, left.bend, right.bend}), left.area + right.area + doubled / 2};
  }

  const Hole& hole_;
  const std::vector<std::pair<uint32_t, uint32_t>>& taken_;
  CapRule rule_;
  size_t count_;
  std::vector<Point> at_, beyond_;  // vertices; normals of the faces beyond the border's edges
  std::vector<Cost> cost_;
  std::vector<uint32_t> tip_;
};

}  // namespace

std::vector<Face> cap_of(const Surface& surface, const Hole& hole,
                         const std::vector<std::pair<uint32_t, uint32_t>>& taken, CapRule rule) {
  return Caps(surface, hole, taken, rule).best();
}

}  // namespace firmtouch::tools
