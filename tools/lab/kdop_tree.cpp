#include "lab/kdop_tree.hpp"

#include <algorithm>
#include <numeric>

namespace firmtouch::lab {
namespace {

using tools::Point;

constexpr uint32_t kMaxAxes = 13;

// Of a 26-DOP: 3 sides, 4 corners, 6 edges. A 14-DOP has sides and corners, an 18-DOP sides and
// edges.
constexpr int kSides[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
constexpr int kCorners[4][3] = {{1, 1, 1}, {1, -1, 1}, {1, 1, -1}, {1, -1, -1}};
constexpr int kEdges[6][3] = {{1, 1, 0}, {1, 0, 1}, {0, 1, 1}, {1, -1, 0}, {1, 0, -1}, {0, 1, -1}};

const int* axis_of(uint32_t axes, uint32_t axis) {
  if (axis < 3) return kSides[axis];
  const bool has_corners = axes != 9;
  if (has_corners && axis < 7) return kCorners[axis - 3];
  return kEdges[axis - (has_corners ? 7 : 3)];
}

double along(const int* axis, Point p) { return axis[0] * p.x + axis[1] * p.y + axis[2] * p.z; }

float rounded(double value, bool up) {
  float f = static_cast<float>(value);
  if (up ? static_cast<double>(f) < value : static_cast<double>(f) > value)
    f = std::nextafter(f, up ? 1e38f : -1e38f);
  return f;
}

}  // namespace

KdopTree::KdopTree(const tools::Surface& surface, uint32_t k) : surface_(surface), axes_(k / 2) {
  std::vector<uint32_t> order(surface.faces.size());
  std::iota(order.begin(), order.end(), 0);
  for (const tools::Face& f : surface.faces)
    centres_.push_back((tools::to_point(surface.vertices[f[0]]) +
                        tools::to_point(surface.vertices[f[1]]) +
                        tools::to_point(surface.vertices[f[2]])) *
                       (1.0 / 3));
  struct Part {
    uint32_t node;
    uint32_t *first, *end;
  };
  nodes_.push_back({});
  std::vector<Part> parts{{0, order.data(), order.data() + order.size()}};
  while (!parts.empty()) {
    const Part part = parts.back();
    parts.pop_back();
    fit(part.node, part.first, part.end);
    if (part.end - part.first == 1) {
      nodes_[part.node].triangle = *part.first;
      continue;
    }
    uint32_t* middle = part.first + split(part.first, part.end);
    const uint32_t left = static_cast<uint32_t>(nodes_.size());
    nodes_[part.node].left = left;
    nodes_.push_back({});
    nodes_.push_back({});
    parts.push_back({left, part.first, middle});
    parts.push_back({left + 1, middle, part.end});
  }
}

void KdopTree::fit(uint32_t node, const uint32_t* first, const uint32_t* end) {
  ranges_.resize(std::max<size_t>(ranges_.size(), size_t{node + 1} * axes_));
  for (uint32_t axis = 0; axis < axes_; ++axis) {
    double low = 1e300, high = -1e300;
    for (const uint32_t* f = first; f != end; ++f)
      for (const uint32_t corner : surface_.faces[*f]) {
        const double at = along(axis_of(axes_, axis), tools::to_point(surface_.vertices[corner]));
        low = std::min(low, at);
        high = std::max(high, at);
      }
    ranges_[node * axes_ + axis] = {rounded(low, false), rounded(high, true)};
  }
}

uint32_t KdopTree::split(uint32_t* first, uint32_t* end) const {
  const uint32_t count = static_cast<uint32_t>(end - first);
  double low[3] = {1e300, 1e300, 1e300}, high[3] = {-1e300, -1e300, -1e300}, sum[3] = {};
  for (const uint32_t* f = first; f != end; ++f) {
    const Point c = centres_[*f];
    for (int k = 0; k < 3; ++k) {
      const double at = along(kSides[k], c);
      sum[k] += at;
      low[k] = std::min(low[k], at);
      high[k] = std::max(high[k], at);
    }
  }
  int axis = 0;
  for (int k = 1; k < 3; ++k)
    if (high[k] - low[k] > high[axis] - low[axis]) axis = k;
  const double mean = sum[axis] / count;
  const uint32_t* middle = std::stable_partition(
      first, end, [&](uint32_t f) { return along(kSides[axis], centres_[f]) < mean; });
  const uint32_t left = static_cast<uint32_t>(middle - first);
  return left == 0 || left == count ? count / 2 : left;
}

bool KdopTree::clips(uint32_t node, const double* from, const double* rate) const {
  double begin = 0, end = 1;
  const Range* range = &ranges_[node * axes_];
  for (uint32_t axis = 0; axis < axes_; ++axis) {
    const double one = (static_cast<double>(range[axis].low) - from[axis]) * rate[axis];
    const double other = (static_cast<double>(range[axis].high) - from[axis]) * rate[axis];
    begin = std::max(begin, std::min(one, other));
    end = std::min(end, std::max(one, other));
    if (begin > end) return false;
  }
  return true;
}

uint32_t KdopTree::crossings(Point a, Point b, Test test, uint64_t& visits) const {
  double from[kMaxAxes], rate[kMaxAxes];
  float low[kMaxAxes], high[kMaxAxes];
  for (uint32_t axis = 0; axis < axes_; ++axis) {
    const double p = along(axis_of(axes_, axis), a), q = along(axis_of(axes_, axis), b);
    from[axis] = p;
    rate[axis] = 1 / (q - p);
    low[axis] = rounded(std::min(p, q), false);
    high[axis] = rounded(std::max(p, q), true);
  }
  const auto overlaps = [&](uint32_t node) {
    const Range* range = &ranges_[node * axes_];
    for (uint32_t axis = 0; axis < axes_; ++axis)
      if (low[axis] > range[axis].high || high[axis] < range[axis].low) return false;
    return true;
  };
  uint32_t found = 0, count = 1;
  uint32_t pending[256] = {0};
  while (count > 0) {
    const uint32_t node = pending[--count];
    ++visits;
    if (!(test == Test::kIntervals ? overlaps(node) : clips(node, from, rate))) continue;
    if (nodes_[node].left == 0) {
      double t;
      found += crosses(surface_, nodes_[node].triangle, a, b, t) ? 1u : 0u;
      continue;
    }
    pending[count++] = nodes_[node].left + 1;
    pending[count++] = nodes_[node].left;
  }
  return found;
}

bool crosses(const tools::Surface& surface, uint32_t triangle, Point a, Point b, double& t) {
  const tools::Face& f = surface.faces[triangle];
  const Point p = tools::to_point(surface.vertices[f[0]]);
  const Point e = tools::to_point(surface.vertices[f[1]]) - p,
              g = tools::to_point(surface.vertices[f[2]]) - p, way = b - a;
  const Point h = cross(way, g);
  const double det = dot(e, h);
  if (!(det > 0 || det < 0)) return false;
  const Point from = a - p;
  const double u = dot(from, h) / det;
  if (!(u >= 0 && u <= 1)) return false;
  const Point q = cross(from, e);
  const double v = dot(way, q) / det;
  if (!(v >= 0 && u + v <= 1)) return false;
  t = dot(g, q) / det;
  return t >= 0 && t <= 1;
}

}  // namespace firmtouch::lab
