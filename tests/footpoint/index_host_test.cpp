// Morse theory as an oracle of completeness: over a surface like a disc minima - saddles + maxima,
// with the border's foot-points and the corners from which the distance grows inwards, add up to
// one.

#include "footpoint/footpoints.hpp"
#include "harness/test.hpp"
#include "spline/sample_splines.hpp"
#include "surface/random.hpp"

namespace {

using namespace firmtouch;
using tools::FootKind;
using tools::Footpoints;
using tools::Point;

int inner_index(const Footpoints& feet, Point p) {
  bool is_complete = false;
  int index = 0;
  for (const tools::Footpoint& f : feet.all(p, is_complete))
    index += f.kind == FootKind::kEnd ? 0 : f.kind == FootKind::kSaddle ? -1 : 1;
  CHECK(is_complete);
  return index;
}

int border_index(const Footpoints& feet, Point p) {
  int index = 0;
  for (size_t k = 0; k < feet.borders().size(); ++k) {
    const tools::Border& border = feet.borders()[k];
    std::vector<tools::Root> roots;
    bool is_zero = false;
    const tools::CurveSystem& c = feet.border_curves()[k];
    roots_of(c.coefficients(p), c.noise(p), roots, is_zero);
    for (const tools::Root& root : roots) {
      const bool is_row = border.side < 2, is_far = border.side % 2 == 1;
      const double fixed = is_far ? 1 : 0;
      const auto at =
          feet.patches()[border.patch].values(p, is_row ? root.t : fixed, is_row ? fixed : root.t);
      const double across = is_row ? at.i : at.h;
      if (is_far ? across < 0 : across > 0) index += root.before < 0 ? 1 : -1;
    }
  }
  return index;
}

int corner_index(const Footpoints& feet, const tools::SplineSurface& s, Point p) {
  int index = 0;
  for (const tools::SurfaceSystem& system : feet.patches()) {
    const tools::BezierPatch& q = system.patch;
    for (int k = 0; k < 4; ++k) {
      const bool far_u = k % 2 == 1, far_v = k > 1;
      if (!test::equal(far_u ? q.u1 : q.u0, far_u ? s.u1 : s.u0)) continue;
      if (!test::equal(far_v ? q.v1 : q.v0, far_v ? s.v1 : s.v0)) continue;
      const auto at = system.values(p, far_u, far_v);
      index += (far_u ? at.h < 0 : at.h > 0) && (far_v ? at.i < 0 : at.i > 0);
    }
  }
  return index;
}

}  // namespace

TEST(TheIndexOfASurfacesFootPointsIsOne) {
  size_t many = 0;
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    const tools::SplineSurface s = tools::hilly_surface(seed, 6, 0.25, seed % 2 == 0);
    const Footpoints feet({}, tools::bezier_pieces(s));
    CHECK_EQ(feet.corners().size(), 4u);
    tools::Random random(seed);
    for (int k = 0; k < 40; ++k) {
      test::note("seed * 100 + query", static_cast<int64_t>(seed) * 100 + k);
      const Point p{random.between(-0.2, 1.2), random.between(-0.2, 1.2),
                    random.between(-0.6, 0.6)};
      const int inner = inner_index(feet, p);
      CHECK_EQ(inner + border_index(feet, p) + corner_index(feet, s, p), 1);
      many += inner != 1;
    }
  }
  CHECK_GT(many, 20u);
}

// Over short ways the sum of an open curve's minima, less its maxima, changes only at its ends, and
// there by one for each.
TEST(TheIndexOfACurveChangesByOneAtItsEnds) {
  for (uint64_t seed = 1; seed <= 20; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    const Footpoints feet(
        tools::bezier_pieces(tools::winding_curve(seed, 14, seed % 2 == 0, seed % 3 == 0)), {});
    tools::Random random(seed);
    for (int k = 0; k < 50; ++k) {
      const Point p{random.between(-0.2, 1.2), random.between(-0.2, 1.2),
                    seed % 2 == 0 ? 0 : random.between(-0.2, 1.2)};
      bool is_complete = false;
      int index = 0;
      for (const tools::Footpoint& f : feet.all(p, is_complete))
        index += f.kind == FootKind::kMin ? 1 : f.kind == FootKind::kMax ? -1 : 0;
      const tools::CurveSystem &a = feet.curves().front(), &b = feet.curves().back();
      index += a.a.c.front() - dot(p - a.origin, a.b.c.front()) > 0;
      index += b.a.c.back() - dot(p - b.origin, b.b.c.back()) < 0;
      CHECK_EQ(index, 1);
    }
  }
}
