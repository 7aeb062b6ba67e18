#include "field/triangle_tree.hpp"

#include <algorithm>
#include <numeric>

namespace firmtouch::tools {
namespace {

void add(FloatBox& box, const FloatBox& other) {
  for (size_t k = 0; k < 3; ++k) {
    box.low[k] = std::min(box.low[k], other.low[k]);
    box.high[k] = std::max(box.high[k], other.high[k]);
  }
}

FloatBox box_of(const TriangleTree::Corners& c) {
  FloatBox box;
  for (size_t k = 0; k < 3; ++k) {
    box.low[k] = std::min({c.at[k], c.at[3 + k], c.at[6 + k]});
    box.high[k] = std::max({c.at[k], c.at[3 + k], c.at[6 + k]});
  }
  return box;
}

// Halves of equal count along the axis on which the middles spread most.
void halve(std::vector<uint32_t>& faces, const std::vector<FloatBox>& boxes, uint32_t begin,
           uint32_t end) {
  const auto middle = [&](uint32_t face, size_t k) {
    return boxes[face].low[k] + boxes[face].high[k];
  };
  size_t axis = 0;
  float widest = -1;
  for (size_t k = 0; k < 3; ++k) {
    float low = middle(faces[begin], k), high = low;
    for (uint32_t i = begin; i < end; ++i) {
      low = std::min(low, middle(faces[i], k));
      high = std::max(high, middle(faces[i], k));
    }
    if (high - low > widest) widest = high - low, axis = k;
  }
  std::nth_element(faces.begin() + begin, faces.begin() + (begin + end) / 2, faces.begin() + end,
                   [&](uint32_t a, uint32_t b) {
                     const float x = middle(a, axis), y = middle(b, axis);
                     return x < y || (!(y < x) && a < b);
                   });
}

// Of the triangle as float32 has it, about `origin`.
TriangleTree::Row disk_of(const TriangleTree::Corners& c) {
  const auto corner = [&](size_t k) {
    return Point{double{c.at[3 * k]}, double{c.at[3 * k + 1]}, double{c.at[3 * k + 2]}};
  };
  const Point a = corner(0), b = corner(1), d = corner(2);
  const Point centre = (a + b + d) * (1.0 / 3), normal = cross(b - a, d - a);
  const double size = length(normal);
  const double radius = std::max({length(a - centre), length(b - centre), length(d - centre)});
  // Lower than a thousandth of its length: a rounded normal would tilt it.
  const Point unit = size > 1e-3 * radius * radius ? normal * (1 / size) : Point{};
  const math::Vec3 at = to_vec3(centre), up = to_vec3(unit);
  return {{at.x, at.y, at.z, up.x, up.y, up.z, static_cast<float>(radius * (1 + 1e-6))}};
}

float dot3(const float* a, const float* b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

float segment2(const float* p, const float* a, const float* b) {
  const float ab[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const float ap[3] = {p[0] - a[0], p[1] - a[1], p[2] - a[2]};
  const float size2 = dot3(ab, ab);
  const float t = std::clamp(size2 > 0 ? dot3(ap, ab) / size2 : 0.0f, 0.0f, 1.0f);
  const float q[3] = {ap[0] - ab[0] * t, ap[1] - ab[1] * t, ap[2] - ab[2] * t};
  return dot3(q, q);
}

}  // namespace

TriangleTree::TriangleTree(const Surface& surface, uint32_t leaf_triangles) {
  const uint32_t count = static_cast<uint32_t>(surface.faces.size());
  Point low = to_point(surface.vertices[0]), high = low;
  for (const math::Vec3& v : surface.vertices) {
    const Point p = to_point(v);
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  origin_m_ = (low + high) * 0.5;
  slack_m_ = static_cast<float>(length(high - low) * 1e-6);
  std::vector<Corners> corners(count);
  std::vector<FloatBox> boxes(count);
  for (uint32_t f = 0; f < count; ++f) {
    for (size_t k = 0; k < 3; ++k) {
      const auto at = local(to_point(surface.vertices[surface.faces[f][k]]));
      std::copy(at.begin(), at.end(), corners[f].at + 3 * k);
    }
    boxes[f] = box_of(corners[f]);
  }
  faces_.resize(count);
  std::iota(faces_.begin(), faces_.end(), 0u);
  nodes_.push_back({{}, 0, count});
  for (uint32_t n = 0; n < nodes_.size(); ++n) {
    const uint32_t begin = nodes_[n].first, end = begin + nodes_[n].count;
    nodes_[n].box = boxes[faces_[begin]];
    for (uint32_t i = begin; i < end; ++i) add(nodes_[n].box, boxes[faces_[i]]);
    if (end - begin <= leaf_triangles) continue;
    halve(faces_, boxes, begin, end);
    const uint32_t middle = (begin + end) / 2;
    nodes_[n].first = static_cast<uint32_t>(nodes_.size());
    nodes_[n].count = 0;
    nodes_.push_back({{}, begin, middle - begin});
    nodes_.push_back({{}, middle, end - middle});
  }
  places_.resize(count);
  for (uint32_t i = 0; i < count; ++i) {
    places_[faces_[i]] = i;
    triangles_.push_back(corners[faces_[i]]);
    const FloatBox& box = boxes[faces_[i]];
    boxes_.push_back({{box.low[0], box.low[1], box.low[2], box.high[0], box.high[1], box.high[2]}});
    disks_.push_back(disk_of(triangles_.back()));
  }
}

float TriangleTree::distance2(const std::array<float, 3>& p, uint32_t triangle) const {
  const float* const a = triangles_[triangle].at;
  const float *const b = a + 3, *const c = a + 6;
  const float ab[3] = {b[0] - a[0], b[1] - a[1], b[2] - a[2]};
  const float ac[3] = {c[0] - a[0], c[1] - a[1], c[2] - a[2]};
  const float ap[3] = {p[0] - a[0], p[1] - a[1], p[2] - a[2]};
  const float n[3] = {ab[1] * ac[2] - ab[2] * ac[1], ab[2] * ac[0] - ab[0] * ac[2],
                      ab[0] * ac[1] - ab[1] * ac[0]};
  const float v[3] = {ap[1] * ac[2] - ap[2] * ac[1], ap[2] * ac[0] - ap[0] * ac[2],
                      ap[0] * ac[1] - ap[1] * ac[0]};
  const float w[3] = {ab[1] * ap[2] - ab[2] * ap[1], ab[2] * ap[0] - ab[0] * ap[2],
                      ab[0] * ap[1] - ab[1] * ap[0]};
  const float n2 = dot3(n, n), of_b = dot3(v, n), of_c = dot3(w, n);
  if (of_b > 0 && of_c > 0 && of_b + of_c < n2) {
    const float height = dot3(ap, n);
    return height * height / n2;
  }
  return std::min({segment2(p.data(), a, b), segment2(p.data(), b, c), segment2(p.data(), c, a)});
}

uint32_t TriangleTree::nearest(const std::array<float, 3>& p, uint32_t seed) const {
  struct Pending {
    float gap2;
    uint32_t node;
  };
  uint32_t best = seed == kNoFace ? 0 : seed;
  float least2 = distance2(p, best);
  Pending stack[64];  // the tree is balanced: 32 levels hold 2^32 leaves
  uint32_t count = 0;
  stack[count++] = {gap2(nodes_[0].box, p, p), 0};
  while (count > 0) {
    const Pending now = stack[--count];
    if (!(now.gap2 < least2)) continue;
    const Node& node = nodes_[now.node];
    if (node.count == 0) {
      const Pending one{gap2(nodes_[node.first].box, p, p), node.first};
      const Pending two{gap2(nodes_[node.first + 1].box, p, p), node.first + 1};
      const bool one_first = one.gap2 <= two.gap2;
      stack[count++] = one_first ? two : one;
      stack[count++] = one_first ? one : two;
      continue;
    }
    for (uint32_t i = node.first; i < node.first + node.count; ++i) {
      const float found2 = distance2(p, i);
      if (found2 < least2) least2 = found2, best = i;
    }
  }
  return best;
}

}  // namespace firmtouch::tools
