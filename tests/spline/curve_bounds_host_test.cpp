// Every bound that a baked curve stands on, as tools/FORMAT.md words it: what holds what, and how
// fast the distance may turn.
#include <cstring>

#include "harness/long.hpp"
#include "harness/test.hpp"
#include "spline/baked_model.hpp"
#include "spline/random_splines.hpp"
#include "spline/read_spline.hpp"
#include "spline/stored_piece.hpp"

using namespace firmtouch::spline_test;
namespace spline = firmtouch::spline;
namespace tools = firmtouch::tools;

namespace {

// Whether all of it lies within a radius of a straight line: of any point of that, a good one.
bool is_in_capsule(const Vector& x, const Plain& from, const Plain& to, float radius) {
  Plain along, off;
  for (size_t k = 0; k < 3; ++k) along[k] = to[k] - from[k], off[k] = middle(x[k]) - from[k];
  const Wide length2 = dot(along, along);
  const Wide t = length2 > 0 ? held(dot(off, along) / length2, 0, 1) : 0;
  Vector rest;
  for (size_t k = 0; k < 3; ++k)
    rest[k] = x[k] - (Interval(from[k]) + (Interval(to[k]) - Interval(from[k])) * Interval(t));
  return longest(rest) <= static_cast<Wide>(radius);
}

// What a byte of a unit stands for.
float of_byte(float unit, uint8_t byte) {
  uint32_t bits;
  std::memcpy(&bits, &unit, sizeof bits);
  bits += uint32_t{byte} << 20;
  std::memcpy(&unit, &bits, sizeof unit);
  return unit;
}

// The points between leaves; those of a flat model lie where its pieces' origins do.
Plain point(const spline::View& view, uint32_t i) {
  return {view.points()[i].x_m, view.points()[i].y_m,
          view.is_flat() ? view.pieces()[0].origin_m[2] : view.heights_m()[i]};
}

// By the words of the format: leaf i is node 2^h + i, with the least 2^h that is not below their
// number.
void check_curve(const spline::View& view) {
  const uint32_t count = view.leaf_count();
  uint32_t first_node = 1;
  while (first_node < count) first_node *= 2;
  for (uint32_t leaf = 0; leaf < count; ++leaf) {
    const uint32_t piece = view.leaves()[leaf];
    if (piece == 0xFFFF) continue;
    const StoredPiece stored(view, piece);
    const uint32_t first = view.curve_bends()[piece].first_leaf;
    const Area area = area_of(view.pieces()[piece].level_u, leaf - first, 0, 0, false);
    firmtouch::test::note("leaf", leaf);
    uint32_t wide = 1;
    for (uint32_t node = first_node + leaf; node != 0; node /= 2, wide *= 2) {
      const uint32_t begin = node * wide - first_node, end = std::min(begin + wide, count);
      const float radius = of_byte(view.head().radius_unit_m, view.curve_radii()[node - 1]);
      CHECK(holds(area, false, kFinestOfCurve, [&](const Area& part) {
        return is_in_capsule(stored.over(part, 0).of[0][0], point(view, begin), point(view, end),
                             radius);
      }));
    }
  }
  for (uint32_t piece = 0; piece < view.pieces().size(); ++piece) {
    firmtouch::test::note("piece", piece);
    const StoredPiece stored(view, piece);
    const Area area{-1, 1};
    const spline::CurveBend& bend = view.curve_bends()[piece];
    const Wide width = width_of(stored, area, false);
    CHECK(holds(area, false, kFinestOfCurve, [&](const Area& part) {
      return bends_no_lower(stored.over(part, 4), width, bend.fixed_m2, bend.turning_m);
    }));
  }
}

using firmtouch::test::is_long;

}  // namespace

TEST(CurveBounds_HoldByIntervals_OfRandomCurves) {
  for (uint32_t seed = 0; seed < (is_long() ? 60u : 5u); ++seed) {
    tools::Random random(seed + 300);
    const tools::SplineCurve curve =
        random_curve(random, 1 + static_cast<int>(seed % 5), 1 + static_cast<int>(seed % 3));
    check_curve(BakedModel(of(curve), seed % 2 == 1).view);
  }
}
