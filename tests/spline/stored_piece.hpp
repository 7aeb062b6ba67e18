#pragma once
// Bounds of a baked spline, by interval arithmetic from its stored coefficients: shares no code
// with the baker and the proof at open.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "harness/test.hpp"
#include "spline/exact_distance.hpp"

namespace firmtouch::spline_test {

using Vector = std::array<Interval, 3>;
constexpr int kOrders = 5;
// Halvings of a part on an axis, before a bound is called wrong: where a bound is met at an end of
// a curve's leaf, intervals come near it by halves. A radius may leave 3 % of it to a part's
// farthest point.
constexpr int kFinest = 12, kFinestOfCurve = 20, kFinestOfBox = 18;
constexpr Wide kNothing = 1e-40L;  // what widening makes of 0

inline Wide most(Interval a) { return std::max(std::fabs(a.lo), std::fabs(a.hi)); }
inline Interval dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Wide longest(const Vector& a) {
  Wide sum = 0;
  for (const Interval& x : a) sum = raised(sum + raised(most(x) * most(x)));
  return raised(std::sqrt(sum));
}
inline Wide factorial(int n) { return n < 2 ? 1 : n * factorial(n - 1); }
inline Wide choose(int n, int k) { return factorial(n) / (factorial(k) * factorial(n - k)); }
inline Wide falling(int n, int k) { return factorial(n) / factorial(n - k); }

// A rectangle of a piece's s and t.
struct Area {
  Wide s0, s1, t0 = 0, t1 = 0;
};

// Derivatives of the point by s and t over an area, up to `order` together; [0][0] is the point.
struct Jet {
  Vector of[kOrders][kOrders];
};

class StoredPiece {
 public:
  StoredPiece(const spline::View& view, uint32_t piece) : piece_(view.pieces()[piece]) {
    const size_t stride = piece_.is_rational != 0 ? 4 : 3;
    const float* from = view.coefficients().data() + piece_.coefficients;
    for (int j = 0; j <= piece_.degree_v; ++j)
      for (int i = 0; i <= piece_.degree_u; ++i, from += stride)
        for (size_t k = 0; k < 4; ++k)
          c_[i][j][k] = k < stride ? static_cast<Wide>(from[k]) : i + j == 0 ? Wide{1} : Wide{0};
  }

  // By Taylor's formula about the middle, whose sums are finite.
  Jet over(const Area& area, int order) const {
    const Wide s = 0.5L * (area.s0 + area.s1), t = 0.5L * (area.t0 + area.t1);
    const Wide hs = raised(0.5L * (area.s1 - area.s0)), ht = raised(0.5L * (area.t1 - area.t0));
    const bool is_point = !(area.s0 < area.s1 || area.t0 < area.t1);
    const int last_u = is_point ? std::min<int>(order, piece_.degree_u) : piece_.degree_u;
    const int last_v = is_point ? std::min<int>(order, piece_.degree_v) : piece_.degree_v;
    Interval middle[6][6][4];  // derivatives there
    for (int i = 0; i <= last_u; ++i)
      for (int j = 0; j <= last_v; ++j)
        for (size_t k = 0; k < 4; ++k) middle[i][j][k] = at(i, j, k, s, t);
    Interval n[kOrders][kOrders][4];
    for (int a = 0; a <= order; ++a)
      for (int b = 0; a + b <= order; ++b)
        for (int i = a; i <= (is_point ? std::min(a, last_u) : last_u); ++i)
          for (int j = b; j <= (is_point ? std::min(b, last_v) : last_v); ++j) {
            const Interval step =
                (i == a && j == b ? Interval(1) : both(power(hs, i - a) * power(ht, j - b))) *
                (Interval(1) / Interval(factorial(i - a) * factorial(j - b)));
            for (size_t k = 0; k < 4; ++k) n[a][b][k] = n[a][b][k] + middle[i][j][k] * step;
          }
    Jet jet;
    for (int a = 0; a <= order; ++a)
      for (int b = 0; a + b <= order; ++b)
        for (size_t k = 0; k < 3; ++k) {
          Interval sum = n[a][b][k];
          for (int i = 0; i <= a; ++i)
            for (int j = 0; j <= b; ++j)
              if (i + j < a + b)
                sum = sum -
                      Interval(choose(a, i) * choose(b, j)) * jet.of[i][j][k] * n[a - i][b - j][3];
          jet.of[a][b][k] = sum / n[0][0][3];
        }
    for (size_t k = 0; k < 3; ++k)
      jet.of[0][0][k] = jet.of[0][0][k] + Interval(static_cast<Wide>(piece_.origin_m[k]));
    return jet;
  }

 private:
  static Wide power(Wide x, int n) { return n == 0 ? 1 : raised(x * power(x, n - 1)); }
  static Interval both(Wide x) { return {-raised(x), raised(x)}; }
  // The (i, j)th derivative of a sum of powers at a place.
  Interval at(int i, int j, size_t k, Wide s, Wide t) const {
    if (k == 3 && piece_.is_rational == 0) return i + j == 0 ? Wide{1} : Wide{0};
    Interval sum;
    for (int m = piece_.degree_v; m >= j; --m) {
      Interval row;
      for (int l = piece_.degree_u; l >= i; --l)
        row = row * s + Interval(c_[l][m][k]) * falling(l, i);
      sum = sum * t + row * falling(m, j);
    }
    return sum;
  }

  const spline::Piece& piece_;
  Wide c_[6][6][4] = {};
};

// Whether a claim holds on an area, or on all its quarters (halves, of a curve) and theirs.
template <class Claim>
bool holds(const Area& area, bool is_surface, int left, Claim claim) {
  if (claim(area)) return true;
  if (left == 0) return false;
  const Wide s = 0.5L * (area.s0 + area.s1), t = 0.5L * (area.t0 + area.t1);
  for (int q = 0; q < (is_surface ? 4 : 2); ++q) {
    Area part = area;
    (q % 2 == 0 ? part.s1 : part.s0) = s;
    if (is_surface) (q < 2 ? part.t1 : part.t0) = t;
    if (!holds(part, is_surface, left - 1, claim)) return false;
  }
  return true;
}

inline Area area_of(uint32_t levels_u, uint32_t i, uint32_t levels_v, uint32_t j, bool is_surface) {
  const Wide wide = 2.0L / static_cast<Wide>(1u << levels_u),
             high = 2.0L / static_cast<Wide>(1u << levels_v);
  Area area{-1 + wide * i, -1 + wide * (i + 1)};
  if (is_surface) area.t0 = -1 + high * j, area.t1 = -1 + high * (j + 1);
  return area;
}

inline Wide middle(Interval a) { return 0.5L * (a.lo + a.hi); }
inline Wide held(Wide x, Wide low, Wide high) { return x > low ? (x < high ? x : high) : low; }
using Plain = std::array<Wide, 3>;
inline Wide dot(const Plain& a, const Plain& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

// The size of a leaf or cell: no two of its points are farther apart.
inline Wide width_of(const StoredPiece& stored, const Area& area, bool is_surface) {
  std::vector<Vector> hulls;
  const int parts = is_surface ? 4 : 32;
  for (int j = 0; j < (is_surface ? parts : 1); ++j)
    for (int i = 0; i < parts; ++i) {
      Area part = area;
      part.s0 = area.s0 + (area.s1 - area.s0) * i / parts;
      part.s1 = area.s0 + (area.s1 - area.s0) * (i + 1) / parts;
      if (is_surface) {
        part.t0 = area.t0 + (area.t1 - area.t0) * j / parts;
        part.t1 = area.t0 + (area.t1 - area.t0) * (j + 1) / parts;
      }
      hulls.push_back(stored.over(part, 0).of[0][0]);
    }
  Wide width = 0;
  for (const Vector& a : hulls)
    for (const Vector& b : hulls)
      width = std::max(width, longest({a[0] - b[0], a[1] - b[1], a[2] - b[2]}));
  return width;
}

// A derivative of D^2 / 2, seen from a point that is D from some point of the area: at most fixed +
// turning D, by the terms with the point and those without; of even powers, nowhere below as much.
inline bool turns_no_faster(const Jet& jet, int a, int b, Wide width, float fixed, float turning) {
  const Wide own = longest(jet.of[a][b]);
  Interval rest;
  for (int i = 0; i <= a; ++i)
    for (int j = 0; j <= b; ++j)
      if (i + j > 0 && i + j < a + b)
        rest = rest + Interval(0.5L * choose(a, i) * choose(b, j)) *
                          dot(jet.of[i][j], jet.of[a - i][b - j]);
  const Wide terms = a % 2 == 0 && b % 2 == 0 ? -rest.lo : most(rest);
  return own <= static_cast<Wide>(turning) + kNothing &&
         raised(terms + raised(own * width)) <= static_cast<Wide>(fixed) + kNothing;
}

// Of a curve the fourth derivative of D^2 / 2, which may be below 0 by as much.
inline bool bends_no_lower(const Jet& jet, Wide width, float fixed, float turning) {
  const Wide own = longest(jet.of[4][0]);
  const Interval rest =
      Interval(4) * dot(jet.of[1][0], jet.of[3][0]) + Interval(3) * dot(jet.of[2][0], jet.of[2][0]);
  return own <= static_cast<Wide>(turning) + kNothing &&
         raised(-rest.lo + raised(own * width)) <= static_cast<Wide>(fixed) + kNothing;
}

}  // namespace firmtouch::spline_test
