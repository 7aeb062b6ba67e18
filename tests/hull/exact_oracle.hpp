#pragma once
// Whether points of a surface lie inside another one, in exact arithmetic that shares no code with
// the tools: whole numbers in digits of 32 bits, and sides of planes as weighted sums.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "surface/box_tree.hpp"
#include "surface/point.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// A point of a triangle: (w0 a + w1 b + w2 c) / 16 with whole weights, 16 in all. Nothing is
/// rounded.
struct Spot {
  std::array<math::Vec3, 3> corner;
  std::array<int, 3> weight;

  Point about() const {
    Point sum;
    for (size_t i = 0; i < 3; ++i) sum = sum + to_point(corner[i]) * (weight[i] / 16.0);
    return sum;
  }
};

inline Spot spot_at(math::Vec3 v) { return {{v, v, v}, {16, 0, 0}}; }

/// A sum of whole numbers times 2^-447.
class LongSum {
 public:
  /// factor * x * y * z
  void add(int factor, float x, float y, float z) {
    if (factor == 0) return;
    int e[3];
    const double m[3] = {std::frexp(static_cast<double>(x), &e[0]),
                         std::frexp(static_cast<double>(y), &e[1]),
                         std::frexp(static_cast<double>(z), &e[2])};
    const int64_t whole[3] = {std::llround(m[0] * 0x1p24), std::llround(m[1] * 0x1p24),
                              std::llround(m[2] * 0x1p24)};
    const int64_t pair = whole[0] * whole[1];
    const int64_t third = whole[2] * factor;
    const int at = e[0] + e[1] + e[2] - 72 + kUnit;
    // Two parts of less than 2^62 each.
    put((pair % (int64_t{1} << 24)) * third, at);
    put((pair / (int64_t{1} << 24)) * third, at + 24);
  }
  int sign() {
    int64_t carry = 0;
    for (int64_t& digit : digit_) {
      const int64_t all = digit + carry;
      digit = all & 0xFFFFFFFF;
      carry = (all - digit) / (int64_t{1} << 32);
    }
    if (carry < 0) return -1;
    for (const int64_t digit : digit_) {
      if (digit != 0) return 1;
    }
    return carry > 0 ? 1 : 0;
  }

 private:
  // Products of three subnormals at the one end, of three numbers below 2^24 at the other.
  static constexpr int kUnit = 520;
  void put(int64_t value, int shift) {
    const bool minus = value < 0;
    uint64_t size = minus ? static_cast<uint64_t>(-value) : static_cast<uint64_t>(value);
    const size_t first = static_cast<size_t>(shift) / 32;
    const unsigned by = static_cast<unsigned>(shift) % 32;
    for (size_t k = first; size != 0; ++k) {
      const unsigned buffer = k == first ? 32 - by : 32;
      const uint64_t part = size & ((uint64_t{1} << buffer) - 1);
      const int64_t digit = static_cast<int64_t>(k == first ? part << by : part);
      digit_[k] += minus ? -digit : digit;
      size >>= buffer;
    }
  }
  std::array<int64_t, 22> digit_{};
};

inline void add_determinant(LongSum& sum, int factor, math::Vec3 a, math::Vec3 b, math::Vec3 c) {
  sum.add(factor, a.x, b.y, c.z);
  sum.add(-factor, a.x, b.z, c.y);
  sum.add(factor, a.y, b.z, c.x);
  sum.add(-factor, a.y, b.x, c.z);
  sum.add(factor, a.z, b.x, c.y);
  sum.add(-factor, a.z, b.y, c.x);
}

/// The sign of (b - a) x (c - a) . (p - a), which is linear in the corners of p.
inline int exact_sign(math::Vec3 a, math::Vec3 b, math::Vec3 c, const Spot& p) {
  LongSum sum;
  for (size_t i = 0; i < 3; ++i) {
    const int w = p.weight[i];
    add_determinant(sum, w, b, c, p.corner[i]);
    add_determinant(sum, w, c, a, p.corner[i]);
    add_determinant(sum, w, a, b, p.corner[i]);
    add_determinant(sum, -w, a, b, c);
  }
  return sum.sign();
}

class Oracle {
 public:
  explicit Oracle(const Surface& surface) : surface_(surface), tree_(boxes_of(surface)) {}

  enum class Where { kInside, kOn, kOutside };

  Where where(const Spot& p) const {
    const Point q = p.about();
    const double slack = 1e-14 * (std::fabs(q.x) + std::fabs(q.y) + std::fabs(q.z));
    found_.clear();
    tree_.overlaps({{q.x - slack, q.y - slack, q.z - slack},
                    {q.x + slack, q.y + slack, std::numeric_limits<double>::infinity()}},
                   found_);
    int winding = 0;
    for (const uint32_t f : found_) {
      const math::Vec3 a = corner(f, 0), b = corner(f, 1), c = corner(f, 2);
      const bool left = is_left(a, b, p, q);
      if (is_left(b, c, p, q) != left || is_left(c, a, p, q) != left) continue;
      const int side = side_of(a, b, c, p, q);
      if (side == 0) return Where::kOn;
      if ((side < 0) == left) winding += left ? 1 : -1;
    }
    if (winding >= 1) return Where::kInside;
    // On a face that stands upright the count was that of a point beside it.
    for (const uint32_t f : found_) {
      if (is_on(corner(f, 0), corner(f, 1), corner(f, 2), p, q)) return Where::kOn;
    }
    return Where::kOutside;
  }

 private:
  static std::vector<Box> boxes_of(const Surface& surface) {
    std::vector<Box> boxes;
    for (const Face& face : surface.faces) {
      const Point a = to_point(surface.vertices[face[0]]), b = to_point(surface.vertices[face[1]]),
                  c = to_point(surface.vertices[face[2]]);
      boxes.push_back(
          {{std::min({a.x, b.x, c.x}), std::min({a.y, b.y, c.y}), std::min({a.z, b.z, c.z})},
           {std::max({a.x, b.x, c.x}), std::max({a.y, b.y, c.y}), std::max({a.z, b.z, c.z})}});
    }
    return boxes;
  }
  math::Vec3 corner(uint32_t f, uint32_t k) const {
    return surface_.vertices[surface_.faces[f][k]];
  }

  static int side_of(math::Vec3 a, math::Vec3 b, math::Vec3 c, const Spot& p, Point q) {
    const Point u = to_point(b) - to_point(a), v = to_point(c) - to_point(a), w = q - to_point(a);
    const auto size = [](Point d) { return std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z); };
    const double side = dot(cross(u, v), w);
    const double error = 4e-15 * size(u) * size(v) * (size(w) + size(q));
    if (std::fabs(side) > error) return side > 0 ? 1 : -1;
    return exact_sign(a, b, c, p);
  }

  // On which side of the line through a and b, seen along an axis (x and y are the first and the
  // second of the other two): the third point of the plane is one unit up the axis.
  static int side_of_line(math::Vec3 a, math::Vec3 b, const Spot& p, Point q, int axis) {
    const auto turned = [axis](math::Vec3 v) {
      return axis == 2   ? math::Vec3{v.x, v.y, 0}
             : axis == 1 ? math::Vec3{v.z, v.x, 0}
                         : math::Vec3{v.y, v.z, 0};
    };
    const Point t = axis == 2   ? Point{q.x, q.y, 0}
                    : axis == 1 ? Point{q.z, q.x, 0}
                                : Point{q.y, q.z, 0};
    Spot flat = p;
    for (math::Vec3& v : flat.corner) v = turned(v);
    math::Vec3 above = turned(a);
    above.z = 1;
    // (b - a) x (above - a) . (p - a) = (p - a) x (b - a) along the axis.
    return -side_of(turned(a), turned(b), above, flat, t);
  }

  // Ties as if p were moved along x by next to nothing and along y by next to nothing of that.
  static bool is_left(math::Vec3 a, math::Vec3 b, const Spot& p, Point q) {
    const int side = side_of_line(a, b, p, q, 2);
    if (side != 0) return side > 0;
    return b.y < a.y || (!(a.y < b.y) && b.x > a.x);
  }

  static bool is_on(math::Vec3 a, math::Vec3 b, math::Vec3 c, const Spot& p, Point q) {
    if (side_of(a, b, c, p, q) != 0) return false;
    for (int axis = 0; axis < 3; ++axis) {
      const int s[3] = {side_of_line(a, b, p, q, axis), side_of_line(b, c, p, q, axis),
                        side_of_line(c, a, p, q, axis)};
      if (std::max({s[0], s[1], s[2]}) > 0 && std::min({s[0], s[1], s[2]}) < 0) return false;
    }
    return true;
  }

  const Surface& surface_;
  BoxTree tree_;
  mutable std::vector<uint32_t> found_;
};

}  // namespace firmtouch::tools
