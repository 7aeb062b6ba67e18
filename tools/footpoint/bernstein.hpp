#pragma once
#include <cstddef>
#include <vector>

#include "surface/point.hpp"

namespace firmtouch::tools {

/// Bernstein coefficients of a polynomial of two variables on the unit square, u fastest; of one
/// variable where degree_v is 0. T: double or Point.
template <class T>
struct Bernstein {
  int degree_u = 0, degree_v = 0;
  std::vector<T> c;

  Bernstein() = default;
  Bernstein(int u, int v)
      : degree_u(u), degree_v(v), c(static_cast<size_t>(u + 1) * static_cast<size_t>(v + 1)) {}
  size_t wide() const { return static_cast<size_t>(degree_u) + 1; }
  size_t high() const { return static_cast<size_t>(degree_v) + 1; }
  T& at(size_t i, size_t j) { return c[j * wide() + i]; }
  const T& at(size_t i, size_t j) const { return c[j * wide() + i]; }
};

using Scalars = Bernstein<double>;
using Points = Bernstein<Point>;

Scalars product(const Scalars& f, const Scalars& g);
Points product(const Points& f, const Scalars& g);
Scalars dot_product(const Points& f, const Points& g);
Scalars derivative_u(const Scalars& f);
Points derivative_u(const Points& f);
Scalars derivative_v(const Scalars& f);
Points derivative_v(const Points& f);
Points difference(const Points& f, const Points& g);  // of equal degrees

/// Both halves in u, in place and into `right`. split_v(): the same in v.
void split_u(Scalars& left, Scalars& right);
void split_v(Scalars& low, Scalars& high);

/// The coefficients over a square (an interval where degree_v is 0) that is larger by `more` on
/// every side.
Scalars extended(const Scalars& f, double more);

double value_at(const Scalars& f, double u, double v);

/// A root of a polynomial of one variable in (0, 1), and the signs of the polynomial just before
/// and after it.
struct Root {
  double t;
  int before, after;
};

/// The roots of `f` in the open interval, in no order: bisection until the signs of the
/// coefficients vary once, then guarded Newton. Coefficients within `noise` of zero count as zero.
/// Where `f` is zero throughout, `is_zero` is set and there are no roots.
void roots_of(const std::vector<double>& f, double noise, std::vector<Root>& roots, bool& is_zero);

/// Of the first coefficient beyond `noise`, or of the last: the sign just inside an end. 0: none.
int first_sign(const std::vector<double>& f, double noise);
int last_sign(const std::vector<double>& f, double noise);

}  // namespace firmtouch::tools
