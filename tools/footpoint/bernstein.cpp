#include "footpoint/bernstein.hpp"

#include <array>
#include <cmath>

namespace firmtouch::tools {
namespace {

constexpr int kMaxDegree = 32;

// Pascal's triangle.
const std::array<double, kMaxDegree + 1>& binomials(int n) {
  static const auto rows = [] {
    std::array<std::array<double, kMaxDegree + 1>, kMaxDegree + 1> all{};
    for (size_t i = 0; i <= kMaxDegree; ++i) {
      all[i][0] = 1;
      for (size_t k = 1; k <= i; ++k) all[i][k] = all[i - 1][k - 1] + (k < i ? all[i - 1][k] : 0);
    }
    return all;
  }();
  return rows[static_cast<size_t>(n)];
}

template <class R, class F, class G, class Times>
Bernstein<R> multiply(const Bernstein<F>& f, const Bernstein<G>& g, Times times) {
  Bernstein<R> h(f.degree_u + g.degree_u, f.degree_v + g.degree_v);
  const auto &fu = binomials(f.degree_u), &fv = binomials(f.degree_v);
  const auto &gu = binomials(g.degree_u), &gv = binomials(g.degree_v);
  const auto &hu = binomials(h.degree_u), &hv = binomials(h.degree_v);
  for (size_t j = 0; j < f.high(); ++j)
    for (size_t i = 0; i < f.wide(); ++i)
      for (size_t l = 0; l < g.high(); ++l)
        for (size_t k = 0; k < g.wide(); ++k) {
          const double share = fu[i] * fv[j] * gu[k] * gv[l] / (hu[i + k] * hv[j + l]);
          h.at(i + k, j + l) = h.at(i + k, j + l) + times(f.at(i, j), g.at(k, l)) * share;
        }
  return h;
}

template <class T>
Bernstein<T> derive_u(const Bernstein<T>& f) {
  if (f.degree_u == 0) return Bernstein<T>(0, f.degree_v);
  Bernstein<T> d(f.degree_u - 1, f.degree_v);
  for (size_t j = 0; j < d.high(); ++j)
    for (size_t i = 0; i < d.wide(); ++i)
      d.at(i, j) = (f.at(i + 1, j) - f.at(i, j)) * static_cast<double>(f.degree_u);
  return d;
}

template <class T>
Bernstein<T> derive_v(const Bernstein<T>& f) {
  if (f.degree_v == 0) return Bernstein<T>(f.degree_u, 0);
  Bernstein<T> d(f.degree_u, f.degree_v - 1);
  for (size_t j = 0; j < d.high(); ++j)
    for (size_t i = 0; i < d.wide(); ++i)
      d.at(i, j) = (f.at(i, j + 1) - f.at(i, j)) * static_cast<double>(f.degree_v);
  return d;
}

// de Casteljau at one half, over `count` coefficients that stand `step` apart: the left half stays,
// the right one goes to `right`.
void halve(double* left, double* right, size_t count, size_t step) {
  for (size_t r = 0; r < count; ++r) {
    right[(count - 1 - r) * step] = left[(count - 1) * step];
    for (size_t i = count - 1; i > r; --i)
      left[i * step] = 0.5 * (left[(i - 1) * step] + left[i * step]);
  }
}

// The coefficients over -more to 1 + more of `count` that stand `step` apart.
void extend(double* f, size_t count, size_t step, double more) {
  for (size_t r = 1; r < count; ++r)  // the end, to 1 + more
    for (size_t i = count - 1; i >= r; --i) f[i * step] += more * (f[i * step] - f[(i - 1) * step]);
  const double begin = -more / (1 + more);
  for (size_t r = 1; r < count; ++r)  // the beginning, to -more
    for (size_t i = 0; i + r < count; ++i) f[i * step] += begin * (f[(i + 1) * step] - f[i * step]);
}

int sign_of(double value, double noise) { return value > noise ? 1 : value < -noise ? -1 : 0; }

int variations(const std::vector<double>& f, double noise) {
  int count = 0, last = 0;
  for (const double value : f) {
    const int sign = sign_of(value, noise);
    if (sign == 0) continue;
    count += last != 0 && sign != last;
    last = sign;
  }
  return count;
}

double casteljau(const double* f, size_t count, double t) {
  std::array<double, kMaxDegree + 1> level{};
  for (size_t i = 0; i < count; ++i) level[i] = f[i];
  for (size_t r = 1; r < count; ++r)
    for (size_t i = 0; i + r < count; ++i) level[i] = (1 - t) * level[i] + t * level[i + 1];
  return level[0];
}

// The one root of a bracket; `before` is the sign at its left.
double refine(const std::vector<double>& f, int before) {
  const size_t n = f.size() - 1;
  std::vector<double> slope(n);
  for (size_t i = 0; i < n; ++i) slope[i] = static_cast<double>(n) * (f[i + 1] - f[i]);
  double low = 0, high = 1, t = 0.5;
  for (int step = 0; step < 100 && high - low > 1e-16; ++step) {
    const double value = casteljau(f.data(), f.size(), t);
    if (sign_of(value, 0) == 0) return t;
    (sign_of(value, 0) == before ? low : high) = t;
    const double next = t - value / casteljau(slope.data(), n, t);
    const double last = t;
    t = next > low && next < high ? next : 0.5 * (low + high);
    if (std::fabs(t - last) <= 1e-16) break;
  }
  return t;
}

struct Part {
  std::vector<double> f;
  double low, size;
};

}  // namespace

Scalars product(const Scalars& f, const Scalars& g) {
  return multiply<double>(f, g, [](double a, double b) { return a * b; });
}
Points product(const Points& f, const Scalars& g) {
  return multiply<Point>(f, g, [](Point a, double b) { return a * b; });
}
Scalars dot_product(const Points& f, const Points& g) {
  return multiply<double>(f, g, [](Point a, Point b) { return dot(a, b); });
}
Scalars derivative_u(const Scalars& f) { return derive_u(f); }
Points derivative_u(const Points& f) { return derive_u(f); }
Scalars derivative_v(const Scalars& f) { return derive_v(f); }
Points derivative_v(const Points& f) { return derive_v(f); }

Points difference(const Points& f, const Points& g) {
  Points d = f;
  for (size_t i = 0; i < d.c.size(); ++i) d.c[i] = f.c[i] - g.c[i];
  return d;
}

void split_u(Scalars& left, Scalars& right) {
  right = left;
  for (size_t j = 0; j < left.high(); ++j)
    halve(&left.c[j * left.wide()], &right.c[j * left.wide()], left.wide(), 1);
}

void split_v(Scalars& low, Scalars& high) {
  high = low;
  for (size_t i = 0; i < low.wide(); ++i) halve(&low.c[i], &high.c[i], low.high(), low.wide());
}

Scalars extended(const Scalars& f, double more) {
  Scalars g = f;
  for (size_t j = 0; j < g.high(); ++j) extend(&g.c[j * g.wide()], g.wide(), 1, more);
  for (size_t i = 0; i < g.wide(); ++i) extend(&g.c[i], g.high(), g.wide(), more);
  return g;
}

double value_at(const Scalars& f, double u, double v) {
  std::array<double, kMaxDegree + 1> column{};
  for (size_t j = 0; j < f.high(); ++j) column[j] = casteljau(&f.c[j * f.wide()], f.wide(), u);
  return casteljau(column.data(), f.high(), v);
}

int first_sign(const std::vector<double>& f, double noise) {
  for (const double value : f)
    if (sign_of(value, noise) != 0) return sign_of(value, noise);
  return 0;
}

int last_sign(const std::vector<double>& f, double noise) {
  for (size_t i = f.size(); i-- > 0;)
    if (sign_of(f[i], noise) != 0) return sign_of(f[i], noise);
  return 0;
}

void roots_of(const std::vector<double>& f, double noise, std::vector<Root>& roots, bool& is_zero) {
  constexpr double kMin = 1e-11;  // narrower than that two roots are one
  is_zero = first_sign(f, noise) == 0;
  if (is_zero) return;
  std::vector<Part> parts{{f, 0, 1}};
  while (!parts.empty()) {
    Part part = std::move(parts.back());
    parts.pop_back();
    const int count = variations(part.f, noise);
    if (count == 0) continue;
    const int before = first_sign(part.f, noise), after = last_sign(part.f, noise);
    if (count == 1) {
      roots.push_back({part.low + part.size * refine(part.f, before), before, after});
      continue;
    }
    if (part.size < kMin) {
      roots.push_back({part.low + 0.5 * part.size, before, after});
      continue;
    }
    Part right{part.f, part.low + 0.5 * part.size, 0.5 * part.size};
    halve(part.f.data(), right.f.data(), part.f.size(), 1);
    part.size *= 0.5;
    if (sign_of(right.f.front(), noise) == 0) {
      const int left_sign = last_sign(part.f, noise), right_sign = first_sign(right.f, noise);
      if (left_sign != 0 && right_sign != 0) roots.push_back({right.low, left_sign, right_sign});
    }
    parts.push_back(std::move(part));
    parts.push_back(std::move(right));
  }
}

}  // namespace firmtouch::tools
