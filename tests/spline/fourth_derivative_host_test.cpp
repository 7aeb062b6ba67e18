// The stored bounds of fourth derivatives against closed forms: polynomials whose fourth
// derivatives of D^2 / 2 are known. A bound must reach the true value, and not twice that: half of
// it is wrong.
#include <cmath>

#include "firmtouch/spline/curve/expansion.hpp"
#include "harness/test.hpp"
#include "spline/baked_model.hpp"
#include "spline/stored_bounds.hpp"

namespace {

using namespace firmtouch;
using namespace firmtouch::spline_test;
using Powers = std::vector<double>;  // coefficients of 1, s, s^2, ...

double choose(size_t n, size_t k) {
  double product = 1;
  for (size_t i = 1; i <= k; ++i)
    product = product * static_cast<double>(n - k + i) / static_cast<double>(i);
  return product;
}

// The polynomial s^power of s from -1 to 1 as Bernstein coefficients of degree n.
Powers bernstein_of(size_t power, size_t n) {
  Powers b(n + 1, 0.0);
  for (size_t k = 0; k <= power; ++k) {  // (2 t - 1)^power
    const double of_t_k = choose(power, k) * std::pow(2.0, static_cast<double>(k)) *
                          ((power - k) % 2 == 0 ? 1.0 : -1.0);
    for (size_t i = k; i <= n; ++i) b[i] += of_t_k * choose(i, k) / choose(n, k);
  }
  return b;
}

struct Term {
  size_t axis, u, v;
  double factor;
};

tools::SplineCurve curve_of(size_t n, const std::vector<Term>& terms) {
  std::vector<tools::ControlPoint> points(n + 1, {0, 0, 0, 1});
  for (const Term& term : terms) {
    const Powers b = bernstein_of(term.u, n);
    for (size_t i = 0; i <= n; ++i)
      (term.axis == 0   ? points[i].x
       : term.axis == 1 ? points[i].y
                        : points[i].z) += term.factor * b[i];
  }
  return bezier(points);
}

tools::SplineSurface surface_of(size_t n, const std::vector<Term>& terms) {
  tools::SplineSurface surface;
  surface.degree_u = surface.degree_v = static_cast<int>(n);
  surface.count_u = surface.count_v = n + 1;
  surface.knots_u.assign(n + 1, 0);
  surface.knots_u.insert(surface.knots_u.end(), n + 1, 1);
  surface.knots_v = surface.knots_u;
  surface.points.assign((n + 1) * (n + 1), {0, 0, 0, 1});
  for (const Term& term : terms) {
    const Powers bu = bernstein_of(term.u, n), bv = bernstein_of(term.v, n);
    for (size_t j = 0; j <= n; ++j)
      for (size_t i = 0; i <= n; ++i) {
        tools::ControlPoint& p = surface.points[j * (n + 1) + i];
        (term.axis == 0 ? p.x : term.axis == 1 ? p.y : p.z) += term.factor * bu[i] * bv[j];
      }
  }
  return surface;
}

// The baker cuts pieces: a derivative by the stored piece's s and t of one by the whole surface's.
double by_piece(const spline::Piece& piece, size_t k) {
  return std::pow(2 * double{piece.half_u}, static_cast<double>(4 - k)) *
         std::pow(2 * double{piece.half_v}, static_cast<double>(k));
}

// Reaches the truth, and less than twice that.
void check_tight(double stored, double truth) {
  CHECK_GE(stored, truth * (1 - 1e-6));
  CHECK_LE(stored, 1.9 * truth);
}

}  // namespace

// C = (s - a s^3, 0, 0): 4 C' C''' + 3 C'' C'' is least in the middle, -24 a.
TEST(CurveBend_ReachesTheLowestFourthDerivative_OfACubic) {
  for (const double a : {0.05, 0.2, 0.3}) {
    const BakedModel baked(of(curve_of(3, {{0, 1, 0, 1.0}, {0, 3, 0, -a}})));
    for (uint32_t i = 0; i < baked.view.pieces().size(); ++i) {  // each reaches the middle or less
      const spline::Piece& piece = baked.view.pieces()[i];
      const bool is_middle =
          std::fabs(double{piece.middle_u} - 0.5) <= double{piece.half_u} * 1.001;
      if (is_middle)
        check_tight(double{baked.view.curve_bends()[i].fixed_m2}, 24 * a * by_piece(piece, 0));
    }
  }
}

// C = (s, b s^4, 0): the fourth derivative of C itself is 24 b all along.
TEST(CurveBend_TurnsAsFastAsTheFourthDerivative_OfAQuartic) {
  for (const double b : {0.01, 0.1}) {
    const BakedModel baked(of(curve_of(4, {{0, 1, 0, 1.0}, {1, 4, 0, b}})));
    for (uint32_t i = 0; i < baked.view.pieces().size(); ++i)
      check_tight(double{baked.view.curve_bends()[i].turning_m},
                  24 * b * by_piece(baked.view.pieces()[i], 0));
  }
}

// S = (u - a u^3 - e u v^2, v - a v^3, 0): uuuu and vvvv are -24 a in the middle, uuvv is -4 e.
TEST(PatchBend_ReachesTheLowestFourthDerivatives_OfABicubic) {
  const double a = 0.1, e = 0.1;
  const BakedModel baked(of(surface_of(
      3, {{0, 1, 0, 1.0}, {0, 3, 0, -a}, {0, 1, 2, -e}, {1, 0, 1, 1.0}, {1, 0, 3, -a}})));
  double most[5] = {};
  for (uint32_t leaf = 0; leaf < baked.view.leaf_count(); ++leaf) {
    const spline::Piece& piece = baked.view.pieces()[baked.view.index_of(leaf).piece];
    for (uint32_t k = 0; k < 5; ++k)
      most[k] = std::fmax(most[k],
                          double{firmtouch::spline_test::bounds_of(baked.view, leaf).fixed_m2[k]} /
                              by_piece(piece, k));
  }
  check_tight(most[0], 24 * a);
  check_tight(most[2], 4 * e);
  check_tight(most[4], 24 * a);
}

// S = (u, v, w): the fourth derivatives of w are constants.
TEST(PatchBend_TurnsAsFastAsTheFourthDerivatives_OfABiquartic) {
  const double b[5] = {0.02, 0.03, 0.05, 0.04, 0.01}, times[5] = {24, 6, 4, 6, 24};
  std::vector<Term> terms{{0, 1, 0, 1.0}, {1, 0, 1, 1.0}};
  for (size_t k = 0; k < 5; ++k) terms.push_back({2, 4 - k, k, b[k]});
  const BakedModel baked(of(surface_of(4, terms)));
  for (uint32_t leaf = 0; leaf < baked.view.leaf_count(); ++leaf) {
    const spline::Piece& piece = baked.view.pieces()[baked.view.index_of(leaf).piece];
    for (uint32_t k = 0; k < 5; ++k)
      check_tight(double{firmtouch::spline_test::bounds_of(baked.view, leaf).turning_m[k]},
                  times[k] * b[k] * by_piece(piece, k));
  }
}

// D^2 / 2 of C = (s - a s^3, 0, 0) from its point in the middle is (s - a s^3)^2 / 2.
TEST(Expansion_NeverBendsMoreThanTheCurve_AboutTheMiddle) {
  const double a = 0.3;
  const BakedModel baked(of(curve_of(3, {{0, 1, 0, 1.0}, {0, 3, 0, -a}})));
  const spline::View& view = baked.view;
  uint32_t ends = 0;
  for (uint32_t i = 0; i < view.pieces().size(); ++i) {
    const spline::Piece& piece = view.pieces()[i];
    const double half = 2 * double{piece.half_u};  // of the piece, by s
    for (const float end : {-1.0f, 1.0f}) {
      if (std::fabs(double{piece.middle_u} + double{piece.half_u * end} - 0.5) > 1e-6) continue;
      ++ends;
      const spline::CurvePoint at = spline::evaluate(piece, view.coefficients().data(), end);
      const float speed2 = dot(at.d1, at.d1);
      const spline::Expansion f = spline::expand(at, {}, 0.0f, 0.0f, speed2, speed2,
                                                 view.curve_bends()[i], view.head().loss_m);
      for (double d = 0.1; d <= 2; d += 0.1) {
        const double s = d * half, truth = std::pow(half * (1 - a * s * s), 2);
        CHECK_LE(double{f.bend_over(-end, static_cast<float>(d))}, truth);
      }
    }
  }
  CHECK_GE(ends, 1u);
}
