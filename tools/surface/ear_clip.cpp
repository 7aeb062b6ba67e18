#include "surface/ear_clip.hpp"

#include <algorithm>

namespace firmtouch::tools {
namespace {

// Ears lower than this are left to the end: exporters weld what is thinner.
constexpr int64_t kMinHeight = 2;

class Polygon {
 public:
  explicit Polygon(const std::vector<Outline>& loops) {
    for (const Outline& loop : loops) {
      loops_.emplace_back();
      for (const DrawingPoint& p : loop) {
        loops_.back().push_back(static_cast<uint32_t>(points_.size()));
        points_.push_back(p);
      }
    }
    if (!loops_.empty()) chain_ = loops_[0];
  }

  // Joins every hole to the chain, the rightmost hole first. Result: false if one cannot be.
  bool join_holes() {
    std::vector<size_t> order;
    for (size_t k = 1; k < loops_.size(); ++k) order.push_back(k);
    const auto rightmost = [&](size_t loop) {
      return *std::max_element(loops_[loop].begin(), loops_[loop].end(),
                               [&](uint32_t a, uint32_t b) { return points_[a].x < points_[b].x; });
    };
    std::sort(order.begin(), order.end(), [&](size_t a, size_t b) {
      const int64_t x = points_[rightmost(a)].x, y = points_[rightmost(b)].x;
      return x > y || (x == y && a < b);
    });
    for (size_t k = 0; k < order.size(); ++k) {
      std::vector<size_t> left(order.begin() + static_cast<std::ptrdiff_t>(k), order.end());
      if (!join(order[k], rightmost(order[k]), left)) return false;
    }
    return true;
  }

  bool is_simple() const {
    const size_t n = chain_.size();
    for (size_t k = 0; k < n; ++k)
      for (size_t m = k + 1; m < n; ++m)
        if (are_crossing(chain_[k], chain_[(k + 1) % n], chain_[m], chain_[(m + 1) % n]))
          return false;
    return true;
  }

  std::vector<Face> clip() {
    std::vector<Face> faces;
    size_t at = 0, missed = 0;
    int64_t height = kMinHeight;
    while (chain_.size() > 3) {
      at %= chain_.size();
      const size_t before = (at + chain_.size() - 1) % chain_.size(),
                   after = (at + 1) % chain_.size();
      if (is_ear(before, at, after, height)) {
        faces.push_back({chain_[before], chain_[at], chain_[after]});
        chain_.erase(chain_.begin() + static_cast<std::ptrdiff_t>(at));
        missed = 0;
        height = kMinHeight;
        continue;  // the next ear begins where this one ended: fans grow
      }
      ++at;
      if (++missed <= chain_.size()) continue;
      if (height == 0) return {};
      height = 0;
      missed = 0;
    }
    faces.push_back({chain_[0], chain_[1], chain_[2]});
    return faces;
  }

 private:
  int64_t turn(uint32_t a, uint32_t b, uint32_t c) const {
    const DrawingPoint &p = points_[a], &q = points_[b], &r = points_[c];
    return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
  }
  bool are_equal(uint32_t a, uint32_t b) const {
    return points_[a].x == points_[b].x && points_[a].y == points_[b].y;
  }
  int64_t distance2(uint32_t a, uint32_t b) const {
    const int64_t x = points_[a].x - points_[b].x, y = points_[a].y - points_[b].y;
    return x * x + y * y;
  }
  bool is_on(uint32_t p, uint32_t a, uint32_t b) const {  // the segment a b
    if (turn(a, b, p) != 0) return false;
    return distance2(a, p) <= distance2(a, b) && distance2(b, p) <= distance2(a, b);
  }
  // Whether segments a b and c d share a point other than a common end.
  bool are_crossing(uint32_t a, uint32_t b, uint32_t c, uint32_t d) const {
    if (are_equal(a, c) || are_equal(a, d) || are_equal(b, c) || are_equal(b, d)) {
      const uint32_t far = are_equal(a, c) || are_equal(b, c) ? d : c;
      const uint32_t own = are_equal(a, c) || are_equal(a, d) ? b : a;
      return (!are_equal(far, own) && is_on(far, a, b)) || is_on(own, c, d);
    }
    const auto sign = [](int64_t x) { return x > 0 ? 1 : x < 0 ? -1 : 0; };
    const int c_side = sign(turn(a, b, c)), d_side = sign(turn(a, b, d));
    const int a_side = sign(turn(c, d, a)), b_side = sign(turn(c, d, b));
    if (c_side * d_side < 0 && a_side * b_side < 0) return true;
    return is_on(c, a, b) || is_on(d, a, b) || is_on(a, c, d) || is_on(b, c, d);
  }
  // Whether `p` lies in the angle of the chain at `at`.
  bool is_in_angle(size_t at, uint32_t p) const {
    const uint32_t corner = chain_[at], before = chain_[(at + chain_.size() - 1) % chain_.size()],
                   after = chain_[(at + 1) % chain_.size()];
    const bool left_of_in = turn(before, corner, p) > 0, left_of_out = turn(corner, after, p) > 0;
    return turn(before, corner, after) > 0 ? left_of_in && left_of_out : left_of_in || left_of_out;
  }
  bool is_visible(uint32_t a, uint32_t b, const std::vector<size_t>& holes) const {
    const auto crosses = [&](const std::vector<uint32_t>& loop) {
      for (size_t k = 0; k < loop.size(); ++k)
        if (are_crossing(a, b, loop[k], loop[(k + 1) % loop.size()])) return true;
      return false;
    };
    if (crosses(chain_)) return false;
    return std::none_of(holes.begin(), holes.end(), [&](size_t k) { return crosses(loops_[k]); });
  }
  bool join(size_t hole, uint32_t from, const std::vector<size_t>& left) {
    std::vector<size_t> nearest(chain_.size());
    for (size_t k = 0; k < nearest.size(); ++k) nearest[k] = k;
    std::stable_sort(nearest.begin(), nearest.end(), [&](size_t a, size_t b) {
      return distance2(chain_[a], from) < distance2(chain_[b], from);
    });
    for (const size_t at : nearest) {
      if (!is_in_angle(at, from) || !is_visible(from, chain_[at], left)) continue;
      const std::vector<uint32_t>& loop = loops_[hole];
      std::vector<uint32_t> joined{chain_[at]};
      const size_t start =
          static_cast<size_t>(std::find(loop.begin(), loop.end(), from) - loop.begin());
      for (size_t k = 0; k <= loop.size(); ++k) joined.push_back(loop[(start + k) % loop.size()]);
      chain_.insert(chain_.begin() + static_cast<std::ptrdiff_t>(at), joined.begin(), joined.end());
      return true;
    }
    return false;
  }
  bool is_ear(size_t before, size_t at, size_t after, int64_t min_height) const {
    const uint32_t a = chain_[before], b = chain_[at], c = chain_[after];
    const int64_t area2 = turn(a, b, c);
    if (area2 <= 0) return false;
    const int64_t longest2 = std::max({distance2(a, b), distance2(b, c), distance2(c, a)});
    const double area = static_cast<double>(area2), height = static_cast<double>(min_height);
    if (area * area < height * height * static_cast<double>(longest2)) return false;
    for (size_t k = 0; k < chain_.size(); ++k) {
      const uint32_t p = chain_[k];
      if (k == before || k == at || k == after) continue;
      if (are_equal(p, a) || are_equal(p, b) || are_equal(p, c)) continue;
      if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
    }
    return true;
  }

  std::vector<DrawingPoint> points_;
  std::vector<std::vector<uint32_t>> loops_;
  std::vector<uint32_t> chain_;
};

}  // namespace

bool is_simple(const Outline& outline) { return Polygon({outline}).is_simple(); }

std::vector<Face> clip_ears(const std::vector<Outline>& loops) {
  Polygon polygon(loops);
  if (loops.empty() || loops[0].size() < 3 || !polygon.join_holes()) return {};
  return polygon.clip();
}

}  // namespace firmtouch::tools
