#include "footpoint/surface_system.hpp"

#include <algorithm>
#include <cmath>

namespace firmtouch::tools {
namespace {

constexpr double kRounding = 256 * 2.3e-16;
constexpr size_t kMaxBoxes = 20000;
constexpr double kMinBox = 1e-7;   // narrower than that roots are one
constexpr double kOutside = 1e-9;  // of a box: a root on its edge belongs to it

bool is_zero(double x) { return !(x < 0) && !(x > 0); }
bool is_zero(Point p) { return is_zero(p.x) && is_zero(p.y) && is_zero(p.z); }

// Whether a row (v constant) or column of coefficients is zero, at the low or the high side.
template <class T>
bool vanishes(const Bernstein<T>& f, bool along_v, bool is_high) {
  const size_t count = along_v ? f.wide() : f.high();
  const size_t fixed = is_high ? (along_v ? f.high() : f.wide()) - 1 : 0;
  for (size_t k = 0; k < count; ++k)
    if (!is_zero(along_v ? f.at(k, fixed) : f.at(fixed, k))) return false;
  return true;
}

// f / v, f / (1 - v), f / u or f / (1 - u).
template <class T>
Bernstein<T> divided(const Bernstein<T>& f, bool along_v, bool is_high) {
  Bernstein<T> g(f.degree_u - !along_v, f.degree_v - along_v);
  const double n = along_v ? f.degree_v : f.degree_u;
  for (size_t j = 0; j < g.high(); ++j) {
    for (size_t i = 0; i < g.wide(); ++i) {
      const auto k = static_cast<double>(along_v ? j : i);
      const size_t up = is_high ? 0 : 1;
      g.at(i, j) = f.at(i + (along_v ? 0 : up), j + (along_v ? up : 0)) *
                   (is_high ? n / (n - k) : n / (k + 1));
    }
  }
  return g;
}

void deflate(Scalars& a, Points& b) {
  for (const bool along_v : {false, true}) {
    for (const bool is_high : {false, true}) {
      while ((along_v ? a.degree_v : a.degree_u) > 1 && vanishes(a, along_v, is_high) &&
             vanishes(b, along_v, is_high)) {
        a = divided(a, along_v, is_high);
        b = divided(b, along_v, is_high);
      }
    }
  }
}

struct Box {
  Scalars h, i;
  double u, v, wide, high;
};

// Whether f has one sign, beyond rounding.
bool is_one_sided(const Scalars& f, double noise) {
  bool above = true, below = true;
  for (const double c : f.c) above &= c > noise, below &= c < -noise;
  return above || below;
}

struct Bound {
  double low, high;
  double most() const { return std::max(std::fabs(low), std::fabs(high)); }
};

// Bounds of x * f + y * g by their coefficients.
Bound bound_of(const Scalars& f, const Scalars& g, double x, double y) {
  Bound b{1e300, -1e300};
  for (size_t k = 0; k < f.c.size(); ++k) {
    const double c = x * f.c[k] + y * g.c[k];
    b.low = std::min(b.low, c), b.high = std::max(b.high, c);
  }
  return b;
}

Bound bound_apart(const Scalars& f, double x, const Scalars& g, double y) {
  Bound b{0, 0};  // of two grids of different shape: the sum of their bounds
  for (int k = 0; k < 2; ++k) {
    const Scalars& s = k == 0 ? f : g;
    const double factor = k == 0 ? x : y;
    double low = 1e300, high = -1e300;
    for (const double c : s.c) low = std::min(low, factor * c), high = std::max(high, factor * c);
    b.low += low, b.high += high;
  }
  return b;
}

Bound combined(const Scalars& f, double x, const Scalars& g, double y) {
  const bool alike = f.degree_u == g.degree_u && f.degree_v == g.degree_v;
  return alike ? bound_of(f, g, x, y) : bound_apart(f, x, g, y);
}

// f raised to degrees u and v.
Scalars raised(const Scalars& f, int u, int v) {
  Scalars ones(u - f.degree_u, v - f.degree_v);
  std::fill(ones.c.begin(), ones.c.end(), 1.0);
  return product(f, ones);
}

enum class Content { kNone, kOneAtMost, kMany };

// What a box may hold, by the system multiplied with the inverse of its mean Jacobian.
Content content_of(const Box& box) {
  const Scalars hu = derivative_u(box.h), hv = derivative_v(box.h);
  const Scalars iu = derivative_u(box.i), iv = derivative_v(box.i);
  const auto mean = [](const Scalars& f) {
    double sum = 0;
    for (const double c : f.c) sum += c;
    return sum / static_cast<double>(f.c.size());
  };
  const double a = mean(hu), b = mean(hv), c = mean(iu), d = mean(iv), det = a * d - b * c;
  if (!(std::fabs(det) > 1e-300)) return Content::kMany;
  const double m[2][2] = {{d / det, -b / det}, {-c / det, a / det}};
  for (const auto& row : m) {
    const Bound g = combined(box.h, row[0], box.i, row[1]);
    const double slack = 1e-13 * g.most();
    if (g.low > slack || g.high < -slack) return Content::kNone;
  }
  const Bound g1u = combined(hu, m[0][0], iu, m[0][1]), g1v = combined(hv, m[0][0], iv, m[0][1]);
  const Bound g2u = combined(hu, m[1][0], iu, m[1][1]), g2v = combined(hv, m[1][0], iv, m[1][1]);
  return g1u.low > g1v.most() && g2v.low > g2u.most() ? Content::kOneAtMost : Content::kMany;
}

}  // namespace

SurfaceSystem::SurfaceSystem(const BezierPatch& given) : patch(given) {
  const ControlPoint& first = patch.points.front();
  origin = {first.x, first.y, first.z};
  const bool weighs = is_rational(patch.points);
  Points x(patch.degree_u, patch.degree_v);
  Scalars w(patch.degree_u, patch.degree_v);
  for (size_t k = 0; k < patch.points.size(); ++k) {
    const ControlPoint& p = patch.points[k];
    w.c[k] = weighs ? p.w : 1;
    x.c[k] = (Point{p.x, p.y, p.z} - origin) * w.c[k];
  }
  for (int k = 0; k < 2; ++k) {
    const Points slope = k == 0 ? derivative_u(x) : derivative_v(x);
    const Scalars bend = k == 0 ? derivative_u(w) : derivative_v(w);
    const Points tangent = weighs ? difference(product(slope, w), product(x, bend)) : slope;
    a[k] = dot_product(x, tangent);
    b[k] = product(tangent, w);
    deflate(a[k], b[k]);
    for (size_t c = 0; c < a[k].c.size(); ++c) {
      scale_a[k] = std::max(scale_a[k], std::fabs(a[k].c[c]));
      scale_b[k] = std::max(scale_b[k], length(b[k].c[c]));
    }
  }
  // Both equations in the same degrees bound their combinations best.
  const int u = std::max(a[0].degree_u, a[1].degree_u), v = std::max(a[0].degree_v, a[1].degree_v);
  for (int k = 0; k < 2; ++k) {
    Scalars ones(u - a[k].degree_u, v - a[k].degree_v);
    std::fill(ones.c.begin(), ones.c.end(), 1.0);
    b[k] = product(b[k], ones);
    a[k] = raised(a[k], u, v);
  }
}

SurfaceSystem::Values SurfaceSystem::values(Point p_m, double u, double v) const {
  const Point q = p_m - origin;
  double value[2], by_u[2], by_v[2];
  for (size_t k = 0; k < 2; ++k) {
    // de Casteljau in v of rows taken in u, value and slope together.
    const auto wide = a[k].wide(), high = a[k].high();
    std::vector<double> row(wide), column(high), slope(high);
    for (size_t j = 0; j < high; ++j) {
      for (size_t i = 0; i < wide; ++i) row[i] = a[k].at(i, j) - dot(q, b[k].at(i, j));
      for (size_t r = 1; r + 1 < wide; ++r)
        for (size_t i = 0; i + r < wide; ++i) row[i] = (1 - u) * row[i] + u * row[i + 1];
      slope[j] = wide > 1 ? static_cast<double>(wide - 1) * (row[1] - row[0]) : 0;
      column[j] = wide > 1 ? (1 - u) * row[0] + u * row[1] : row[0];
    }
    for (size_t r = 1; r + 1 < high; ++r)
      for (size_t j = 0; j + r < high; ++j) {
        column[j] = (1 - v) * column[j] + v * column[j + 1];
        slope[j] = (1 - v) * slope[j] + v * slope[j + 1];
      }
    by_v[k] = high > 1 ? static_cast<double>(high - 1) * (column[1] - column[0]) : 0;
    value[k] = high > 1 ? (1 - v) * column[0] + v * column[1] : column[0];
    by_u[k] = high > 1 ? (1 - v) * slope[0] + v * slope[1] : slope[0];
  }
  return {value[0], value[1], by_u[0], by_v[0], by_u[1], by_v[1]};
}

void SurfaceSystem::gradients(double u, double v, Point& by_h, Point& by_i) const {
  Point* into[2] = {&by_h, &by_i};
  for (size_t k = 0; k < 2; ++k) {
    std::vector<Point> column(b[k].high()), row(b[k].wide());
    for (size_t j = 0; j < b[k].high(); ++j) {
      for (size_t i = 0; i < row.size(); ++i) row[i] = b[k].at(i, j);
      for (size_t r = 1; r < row.size(); ++r)
        for (size_t i = 0; i + r < row.size(); ++i) row[i] = row[i] * (1 - u) + row[i + 1] * u;
      column[j] = row[0];
    }
    for (size_t r = 1; r < column.size(); ++r)
      for (size_t j = 0; j + r < column.size(); ++j)
        column[j] = column[j] * (1 - v) + column[j + 1] * v;
    *into[k] = column[0];
  }
}

void SurfaceSystem::solve(Point p_m, std::vector<SurfaceRoot>& roots, size_t& boxes,
                          bool& is_complete, double more) const {
  const Point q = p_m - origin;
  double noise[2];
  Box whole{a[0], a[1], -more, -more, 1 + 2 * more, 1 + 2 * more};
  for (size_t c = 0; c < whole.h.c.size(); ++c) whole.h.c[c] -= dot(q, b[0].c[c]);
  for (size_t c = 0; c < whole.i.c.size(); ++c) whole.i.c[c] -= dot(q, b[1].c[c]);
  whole.h = extended(whole.h, more), whole.i = extended(whole.i, more);
  for (size_t k = 0; k < 2; ++k) noise[k] = kRounding * (scale_a[k] + length(q) * scale_b[k]);

  const auto add = [&](double u, double v) {
    for (const SurfaceRoot& known : roots)
      if (std::fabs(known.u - u) < 1e-7 && std::fabs(known.v - v) < 1e-7) return;
    const Values at = values(p_m, u, v);
    roots.push_back({u, v, at.h_u * at.i_v - at.h_v * at.i_u, at.h_u});
  };
  // Newton from the middle of a box; whether it ends in the box.
  const auto newton = [&](const Box& box) {
    double u = box.u + 0.5 * box.wide, v = box.v + 0.5 * box.high;
    for (int step = 0; step < 20; ++step) {
      const Values at = values(p_m, u, v);
      const double det = at.h_u * at.i_v - at.h_v * at.i_u;
      const double du = (at.h_v * at.i - at.i_v * at.h) / det;
      const double dv = (at.i_u * at.h - at.h_u * at.i) / det;
      if (!(std::fabs(du) < 2 * box.wide && std::fabs(dv) < 2 * box.high)) return false;
      u += du, v += dv;
      if (std::fabs(du) + std::fabs(dv) > 1e-14) continue;
      if (u < box.u - kOutside || u > box.u + box.wide + kOutside || v < box.v - kOutside ||
          v > box.v + box.high + kOutside)
        return false;
      add(std::clamp(u, 0.0, 1.0), std::clamp(v, 0.0, 1.0));
      return true;
    }
    return false;
  };

  std::vector<Box> stack{std::move(whole)};
  size_t looked_at = 0;
  while (!stack.empty()) {
    Box box = std::move(stack.back());
    stack.pop_back();
    ++boxes;
    if (++looked_at > kMaxBoxes) {
      is_complete = false;
      return;
    }
    if (is_one_sided(box.h, noise[0]) || is_one_sided(box.i, noise[1])) continue;
    const Content content = content_of(box);
    if (content == Content::kNone) continue;
    if (content == Content::kOneAtMost && newton(box)) continue;
    if (box.wide < kMinBox && box.high < kMinBox) {
      add(std::clamp(box.u + 0.5 * box.wide, 0.0, 1.0),
          std::clamp(box.v + 0.5 * box.high, 0.0, 1.0));
      continue;
    }
    Box other = box;
    if (box.wide >= box.high) {
      split_u(box.h, other.h), split_u(box.i, other.i);
      box.wide = other.wide = 0.5 * box.wide;
      other.u = box.u + box.wide;
    } else {
      split_v(box.h, other.h), split_v(box.i, other.i);
      box.high = other.high = 0.5 * box.high;
      other.v = box.v + box.high;
    }
    stack.push_back(std::move(box));
    stack.push_back(std::move(other));
  }
}

}  // namespace firmtouch::tools
