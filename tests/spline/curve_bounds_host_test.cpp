// Every bound that a baked curve stands on, as tools/FORMAT.md words it: what holds what, and how fast the
// distance may turn.
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <string>

#include "harness/test.hpp"
#include "spline/random_splines.hpp"
#include "spline/read_spline.hpp"
#include "spline/stored_piece.hpp"

using namespace firmtouch::spline_test;
namespace spline = firmtouch::spline;
namespace tools = firmtouch::tools;

namespace {

// Whether all of it lies within a radius of a straight line: of any point of that, a good one.
bool is_in_capsule(const Vector& x, const spline::Point& a, const spline::Point& b, float radius) {
  const Plain from = {a.x_m, a.y_m, a.z_m}, to = {b.x_m, b.y_m, b.z_m};
  Plain along, off;
  for (size_t k = 0; k < 3; ++k) along[k] = to[k] - from[k], off[k] = middle(x[k]) - from[k];
  const Wide length2 = dot(along, along);
  const Wide t = length2 > 0 ? held(dot(off, along) / length2, 0, 1) : 0;
  Vector rest;
  for (size_t k = 0; k < 3; ++k)
    rest[k] = x[k] - (Interval(from[k]) + (Interval(to[k]) - Interval(from[k])) * Interval(t));
  return longest(rest) <= static_cast<Wide>(radius);
}

float of_half(uint16_t stored) {
  const uint32_t bits = static_cast<uint32_t>(stored) << 16;
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

void check_curve(const spline::View& view) {
  for (uint32_t leaf = 0; leaf < view.leaf_count(); ++leaf) {
    const spline::Leaf& place = view.leaves()[leaf];
    const StoredPiece stored(view, place.piece);
    const Area area = area_of(view.pieces()[place.piece].level_u, place.index_u, 0, 0, false);
    firmtouch::test::note("leaf", leaf);
    uint32_t node = view.leaf_count() - 1 + leaf;
    for (bool is_root = false; !is_root; node = (node - 1) / 2) {
      const spline::Capsule& c = view.capsules()[node];
      CHECK(holds(area, false, kFinestOfCurve, [&](const Area& part) {
        return is_in_capsule(stored.over(part, 0).of[0][0], view.points()[c.first],
                             view.points()[c.last], of_half(c.radius));
      }));
      is_root = node == 0;
    }
    const Wide width = width_of(stored, area, false);
    CHECK(holds(area, false, kFinestOfCurve, [&](const Area& part) {
      return turns_no_faster(stored.over(part, 3), 3, 0, width, of_half(view.bends()[leaf].fixed),
                             of_half(view.bends()[leaf].turning));
    }));
  }
}

bool is_long() { return std::getenv("FIRMTOUCH_LONG") != nullptr; }

}  // namespace

TEST(EveryBoundBakedOfRandomCurvesHoldsByIntervals) {
  for (uint32_t seed = 0; seed < (is_long() ? 60u : 5u); ++seed) {
    tools::Random random(seed + 300);
    tools::SplineModel model;
    model.curves.push_back(
        random_curve(random, 1 + static_cast<int>(seed % 5), 1 + static_cast<int>(seed % 3)));
    check_curve(BakedModel(model, seed % 2 == 1).view);
  }
}
