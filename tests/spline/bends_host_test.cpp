// The baked bounds of fourth derivatives, of even powers from below, against differences of D^2 / 2
// in double.
#include <cmath>

#include "bake/spline/bake_spline.hpp"
#include "firmtouch/spline/proof/leaf_shape.hpp"
#include "firmtouch/spline/proof/opening.hpp"
#include "harness/test.hpp"
#include "spline/random_splines.hpp"
#include "spline/stored_bounds.hpp"
#include "spline/stored_point.hpp"

namespace {

namespace spline = firmtouch::spline;
namespace tools = firmtouch::tools;

// Of a stored piece at s, t, from its coefficients.
tools::Point point_of(const spline::View& view, const spline::Piece& piece, double s, double t) {
  double at[3];
  firmtouch::spline_test::stored_point(piece, view.coefficients().data(), s, t, at);
  return {at[0], at[1], at[2]};
}

// On random leaves, at random places, along random directions, from random queries.
void check_at(const tools::SplineModel& model, uint32_t seed) {
  tools::SplineReport report;
  const auto sections = tools::bake_spline(
      model, "x",
      model.surfaces.empty() ? tools::curve_detail(false) : tools::surface_detail(false), report);
  CHECK(report.problem.empty());
  spline::View view;
  CHECK(tools::open_baked(sections, "x", view).ok());
  if (!view.is_open()) return;
  tools::Random random(seed);
  // A difference is a mean of the derivative.
  const uint32_t order = 4;
  const double choose[] = {1, 4, 6, 4, 1};
  for (int trial = 0; trial < 2000; ++trial) {
    const uint32_t i = random.below(view.leaf_count());
    CHECK(view.is_leaf(i));
    const spline::View::LeafIndex place = view.index_of(i);
    const firmtouch::spline_test::Bounds bounds = firmtouch::spline_test::bounds_of(view, i);
    const spline::Piece& piece = view.pieces()[place.piece];
    const spline::Region part = spline::region_of(piece, place.index_u, place.index_v);
    const double angle = random.between(0, 6.283185307);
    const double eu = view.is_surface() ? std::cos(angle) : 1;
    const double ev = view.is_surface() ? std::sin(angle) : 0;
    const double h = 0.05;
    const double x = random.between(2 * h - 1, 1 - 2 * h), y = random.between(2 * h - 1, 1 - 2 * h);
    const double size = random.below(2) == 0 ? 0.02 : 2;
    const tools::Point on = point_of(view, piece, double{part.middle_u}, double{part.middle_v});
    const tools::Point p =
        on + tools::Point{random.bell(), random.bell(), random.bell()} * (size * report.extent_m);
    const auto half_square = [&](double step) {
      const tools::Point off =
          point_of(view, piece, double{part.middle_u} + double{part.half_u} * (x + step * eu),
                   view.is_surface() ? double{part.middle_v} + double{part.half_v} * (y + step * ev)
                                     : 0) -
          p;
      return 0.5 * dot(off, off);
    };
    const double far = half_square(2 * h), near = half_square(h), back = half_square(-h),
                 behind = half_square(-2 * h);
    const double found =
        (far - 4 * near + 6 * half_square(0) - 4 * back + behind) / (h * h * h * h);
    const double distance = std::sqrt(2 * half_square(0));
    double bound = 0;
    for (uint32_t k = 0; k < (view.is_surface() ? 5u : 1u); ++k) {
      // Returned as the piece's s and t.
      const double each_way = std::pow(double{part.half_u}, order - k) *
                              (view.is_surface() ? std::pow(double{part.half_v}, k) : 1);
      const double of =
          (double{bounds.fixed_m2[k]} + double{bounds.turning_m[k]} * distance) * each_way;
      const double times = view.is_surface() ? choose[k] : 1;
      bound += times * of * std::pow(std::fabs(eu), order - k) * std::pow(std::fabs(ev), k);
    }
    // Differences of doubles are off by about 1e-15 / h^order of the square.
    const double noise = 1e-8 * (distance * distance + report.extent_m * report.extent_m);
    firmtouch::test::note("seed * 10000 + trial", seed * 10000 + static_cast<uint32_t>(trial));
    CHECK_LE(-found, bound * 1.001 + noise);
  }
}

}  // namespace

TEST(FourthDerivative_StaysWithinItsBound_AtRandomPoints) {
  for (uint32_t seed = 0; seed < 12; ++seed) {
    tools::Random random(seed + 900);
    tools::SplineModel model;
    if (seed % 2 == 0)
      model.curves.push_back(
          firmtouch::spline_test::random_curve(random, 2 + static_cast<int>(seed / 2 % 4), 1));
    else
      model.surfaces.push_back(
          firmtouch::spline_test::random_surface(random, 3, 2 + static_cast<int>(seed / 2 % 2), 1));
    check_at(model, seed);
  }
}
