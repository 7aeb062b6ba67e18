#pragma once
// The distance to a spline file by interval arithmetic: two numbers between which it certainly
// lies. Shares no code with baker and firmware, from the file's knots on.
#include <algorithm>
#include <cmath>
#include <vector>

#include "spline/spline.hpp"

namespace firmtouch::spline_test {

using Wide = long double;  // of 64 bits on x86, and nowhere of fewer than a double's
constexpr Wide kRounding = sizeof(Wide) > 8 ? 0x1p-63L : 0x1p-52L;

/// Holds what was computed exactly: each operation widens by more than it rounds.
struct Interval {
  Wide lo = 0, hi = 0;
  Interval() = default;
  Interval(Wide at) : lo(at), hi(at) {}
  Interval(Wide low, Wide high) : lo(low), hi(high) {}
};

inline Wide lowered(Wide x) { return x - (std::fabs(x) * kRounding + 0x1p-1000L); }
inline Wide raised(Wide x) { return x + (std::fabs(x) * kRounding + 0x1p-1000L); }
inline Interval operator+(Interval a, Interval b) {
  return {lowered(a.lo + b.lo), raised(a.hi + b.hi)};
}
inline Interval operator-(Interval a, Interval b) {
  return {lowered(a.lo - b.hi), raised(a.hi - b.lo)};
}
inline Interval operator*(Interval a, Interval b) {
  const Wide p[4] = {a.lo * b.lo, a.lo * b.hi, a.hi * b.lo, a.hi * b.hi};
  return {lowered(std::min({p[0], p[1], p[2], p[3]})), raised(std::max({p[0], p[1], p[2], p[3]}))};
}
inline Interval operator*(Interval a, Wide b) {
  const Wide p = a.lo * b, q = a.hi * b;
  return p < q ? Interval(lowered(p), raised(q)) : Interval(lowered(q), raised(p));
}
/// Pre: b does not hold 0.
inline Interval operator/(Interval a, Interval b) {
  return a * Interval(lowered(1 / b.hi), raised(1 / b.lo));
}

class ExactDistance {
 public:
  explicit ExactDistance(const tools::SplineModel& model) {
    for (const tools::SplineCurve& curve : model.curves) add(curve);
    for (const tools::SplineSurface& surface : model.surfaces) add(surface);
    for (const Net& net : nets_)
      for (size_t k = 0; k < 3; ++k) {
        low_[k] = std::min(low_[k], net.low[k]);
        high_[k] = std::max(high_[k], net.high[k]);
      }
    for (size_t k = 0; k < 3; ++k) size_ = std::max(size_, high_[k] - low_[k]);
  }

  /// Low and high bound, about 1e-9 of the size apart (2e-8 on the shape itself).
  Interval distance(const tools::Point& p) const {
    const Wide at[3] = {p.x, p.y, p.z};
    std::vector<std::pair<Wide, size_t>> order;
    for (size_t i = 0; i < nets_.size(); ++i) order.push_back({outside2(nets_[i], at), i});
    std::sort(order.begin(), order.end());
    Wide best2 = HUGE_VALL, floor2 = HUGE_VALL;
    cells_ = 0;
    std::vector<Cell> stack;
    for (const auto& [near2, i] : order) {
      if (near2 >= best2) break;
      stack.push_back(squared(nets_[i], at));
      search(stack, best2, floor2);
    }
    floor2 = std::max(Wide{0}, std::min(floor2, best2));
    return {std::max(Wide{0}, lowered(std::sqrt(floor2))), raised(std::sqrt(best2))};
  }
  size_t cells() const { return cells_; }

 private:
  using H = std::vector<Interval>;  // x w, y w, z w, w
  struct Net {                      // a Bezier piece: (p + 1) by (q + 1) points, u fastest
    int p = 0, q = 0;
    std::vector<H> points;
    Wide low[3] = {HUGE_VALL, HUGE_VALL, HUGE_VALL};
    Wide high[3] = {-HUGE_VALL, -HUGE_VALL, -HUGE_VALL};
  };
  struct Cell {  // Bernstein coefficients of the numerator and the denominator of D^2
    int p = 0, q = 0;
    std::vector<Interval> s, w;
  };

  static H of(const tools::ControlPoint& c) {
    return {Interval(c.x) * c.w, Interval(c.y) * c.w, Interval(c.z) * c.w, c.w};
  }

  // The value of the polar form of the span `k` at n arguments: de Boor with an argument a level.
  static H polar(const std::vector<double>& knots, int n, size_t k, std::vector<H> d,
                 const std::vector<double>& args) {
    for (int r = 1; r <= n; ++r)
      for (int j = n; j >= r; --j) {
        const size_t i = k - static_cast<size_t>(n) + static_cast<size_t>(j);
        const Interval from = knots[i], to = knots[i + static_cast<size_t>(n - r) + 1];
        const Interval share = (Interval(args[static_cast<size_t>(r - 1)]) - from) / (to - from);
        const size_t at = static_cast<size_t>(j);
        for (size_t c = 0; c < 4; ++c) d[at][c] = d[at - 1][c] + share * (d[at][c] - d[at - 1][c]);
      }
    return d[static_cast<size_t>(n)];
  }

  // The Bezier points over [a, b] of n + 1 points that span `k` stands on.
  static std::vector<H> bezier(const std::vector<double>& knots, int n, size_t k,
                               const std::vector<H>& points, double a, double b) {
    std::vector<H> made;
    for (int j = 0; j <= n; ++j) {
      std::vector<double> args(static_cast<size_t>(n - j), a);
      args.insert(args.end(), static_cast<size_t>(j), b);
      const auto first = points.begin() + static_cast<std::ptrdiff_t>(k) - n;
      made.push_back(polar(knots, n, k, std::vector<H>(first, first + n + 1), args));
    }
    return made;
  }

  template <class Take>
  static void spans(const std::vector<double>& knots, double low, double high, Take take) {
    for (size_t k = 0; k + 1 < knots.size(); ++k) {
      const double a = std::max(knots[k], low), b = std::min(knots[k + 1], high);
      if (b > a) take(k, a, b);
    }
  }

  void add(const tools::SplineCurve& c) {
    std::vector<H> points;
    for (const tools::ControlPoint& p : c.points) points.push_back(of(p));
    spans(c.knots, c.t0, c.t1, [&](size_t k, double a, double b) {
      Net net;
      net.p = c.degree;
      net.points = bezier(c.knots, c.degree, k, points, a, b);
      keep(std::move(net));
    });
  }

  void add(const tools::SplineSurface& s) {
    spans(s.knots_v, s.v0, s.v1, [&](size_t kv, double va, double vb) {
      std::vector<std::vector<H>> columns;  // by u: the points across v
      for (size_t i = 0; i < s.count_u; ++i) {
        std::vector<H> column;
        for (size_t j = 0; j < s.count_v; ++j) column.push_back(of(s.points[j * s.count_u + i]));
        columns.push_back(bezier(s.knots_v, s.degree_v, kv, column, va, vb));
      }
      spans(s.knots_u, s.u0, s.u1, [&](size_t ku, double ua, double ub) {
        Net net;
        net.p = s.degree_u, net.q = s.degree_v;
        for (size_t j = 0; j <= static_cast<size_t>(s.degree_v); ++j) {
          std::vector<H> row;
          for (size_t i = 0; i < s.count_u; ++i) row.push_back(columns[i][j]);
          for (const H& h : bezier(s.knots_u, s.degree_u, ku, row, ua, ub)) net.points.push_back(h);
        }
        keep(std::move(net));
      });
    });
  }

  void keep(Net net) {
    for (const H& h : net.points)
      for (size_t k = 0; k < 3; ++k) {
        const Interval at = h[k] / h[3];
        net.low[k] = std::min(net.low[k], at.lo);
        net.high[k] = std::max(net.high[k], at.hi);
      }
    nets_.push_back(std::move(net));
  }

  static Wide outside2(const Net& net, const Wide (&at)[3]) {
    Wide sum = 0;
    for (size_t k = 0; k < 3; ++k) {
      const Wide off =
          std::max({Wide{0}, lowered(net.low[k] - at[k]), lowered(at[k] - net.high[k])});
      sum = lowered(sum + lowered(off * off));
    }
    return sum;
  }

  static Wide choose(int n, int k) {
    Wide c = 1;
    for (int i = 0; i < k; ++i) c = c * (n - i) / (i + 1);
    return c;
  }

  static Cell squared(const Net& net, const Wide (&at)[3]) {
    const int p = net.p, q = net.q;
    std::vector<H> n = net.points;
    for (H& h : n)
      for (size_t k = 0; k < 3; ++k) h[k] = h[k] - h[3] * Interval(at[k]);
    Cell cell;
    cell.p = 2 * p, cell.q = 2 * q;
    const size_t wide = static_cast<size_t>(2 * p + 1);
    cell.s.assign(wide * static_cast<size_t>(2 * q + 1), Interval());
    cell.w = cell.s;
    const auto index = [&](int i, int j) { return static_cast<size_t>(j * (p + 1) + i); };
    for (int j = 0; j <= q; ++j)
      for (int i = 0; i <= p; ++i)
        for (int l = 0; l <= q; ++l)
          for (int k = 0; k <= p; ++k) {
            const H &a = n[index(i, j)], &b = n[index(k, l)];
            const Interval share =
                Interval(choose(p, i) * choose(p, k) * choose(q, j) * choose(q, l)) /
                Interval(choose(2 * p, i + k) * choose(2 * q, j + l));
            const size_t to = static_cast<size_t>(j + l) * wide + static_cast<size_t>(i + k);
            cell.s[to] = cell.s[to] + share * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
            cell.w[to] = cell.w[to] + share * (a[3] * b[3]);
          }
    return cell;
  }

  // De Casteljau at the middle, along one axis.
  static void halve(std::vector<Interval>& c, std::vector<Interval>& right, int p, int q,
                    bool along_v) {
    right = c;
    const size_t wide = static_cast<size_t>(p + 1), high = static_cast<size_t>(q + 1);
    const size_t n = along_v ? high : wide, lines = along_v ? wide : high;
    for (size_t line = 0; line < lines; ++line) {
      const auto at = [&](size_t i) { return along_v ? i * wide + line : line * wide + i; };
      for (size_t r = 1; r <= n; ++r) {
        right[at(n - r)] = c[at(n - 1)];
        for (size_t i = n - 1; i >= r; --i) {
          const Interval a = c[at(i - 1)], b = c[at(i)];
          c[at(i)] = {0.5L * lowered(a.lo + b.lo), 0.5L * raised(a.hi + b.hi)};
        }
      }
    }
  }

  // How much the coefficients change along an axis.
  static Wide change(const Cell& cell, bool along_v) {
    const size_t wide = static_cast<size_t>(cell.p + 1), high = static_cast<size_t>(cell.q + 1);
    Wide sum = 0;
    for (size_t j = along_v ? 1 : 0; j < high; ++j)
      for (size_t i = along_v ? 0 : 1; i < wide; ++i) {
        const size_t to = j * wide + i, from = along_v ? to - wide : to - 1;
        sum = std::max(
            sum, std::fabs(cell.s[to].lo / cell.w[to].lo - cell.s[from].lo / cell.w[from].lo));
      }
    return sum;
  }

  void search(std::vector<Cell>& stack, Wide& best2, Wide& floor2) const {
    while (!stack.empty()) {
      Cell cell = std::move(stack.back());
      stack.pop_back();
      ++cells_;
      Wide low2 = HUGE_VALL;
      for (size_t k = 0; k < cell.s.size(); ++k)
        low2 = std::min(low2, (Interval(std::max(Wide{0}, cell.s[k].lo)) / cell.w[k]).lo);
      const size_t wide = static_cast<size_t>(cell.p), all = cell.s.size();
      const size_t corners[4] = {0, wide, all - 1 - wide, all - 1};
      for (const size_t k : corners) {
        const Interval at = cell.s[k] / cell.w[k];
        if (at.lo >= 0)
          best2 = std::min(best2, at.hi);
        else
          best2 = std::min(best2, std::max(at.hi, Wide{0}));
      }
      const Wide enough =
          2e-9L * size_ * std::sqrt(best2) + 2e-16L * size_ * size_ + 1e-16L * best2;
      if (low2 >= best2 - enough || cells_ > kMaxCells) {
        floor2 = std::min(floor2, low2);
        continue;
      }
      const bool along_v = cell.q > 0 && change(cell, true) > change(cell, false);
      Cell right;
      right.p = cell.p, right.q = cell.q;
      halve(cell.s, right.s, cell.p, cell.q, along_v);
      halve(cell.w, right.w, cell.p, cell.q, along_v);
      stack.push_back(std::move(cell));
      stack.push_back(std::move(right));
    }
  }

  static constexpr size_t kMaxCells = 300000;  // of a query: beyond it the bounds stay apart
  std::vector<Net> nets_;
  Wide low_[3] = {HUGE_VALL, HUGE_VALL, HUGE_VALL}, high_[3] = {-HUGE_VALL, -HUGE_VALL, -HUGE_VALL};
  Wide size_ = 0;
  mutable size_t cells_ = 0;
};

}  // namespace firmtouch::spline_test
