// Marching: foot-points carried along a path are those found from scratch, with the counts that the
// critical sets allow; and the sets lie where curvature says.
#include "footpoint/tracker.hpp"

#include <cmath>

#include "harness/test.hpp"
#include "spline/sample_splines.hpp"
#include "surface/random.hpp"

namespace {

using namespace firmtouch;
using tools::CriticalGrid;
using tools::Footpoints;
using tools::Point;
using tools::Tracker;

struct Followed {
  size_t wrong = 0, moves = 0;
  tools::TrackerCounts counts;
};

Followed follow(const Footpoints& feet, const CriticalGrid& grid, const std::vector<Point>& path,
                const tools::TrackerOptions& options) {
  Tracker tracker(feet, grid, options);
  Followed result;
  tracker.start(path[0]);
  for (size_t k = 1; k < path.size(); ++k) {
    tracker.move(path[k]);
    bool is_complete = false;
    const double truth = feet.all(path[k], is_complete).front().distance_m;
    ++result.moves;
    result.wrong += std::fabs(tracker.distance_m() - truth) > 1e-9;
  }
  result.counts = tracker.counts();
  return result;
}

size_t inner(const Footpoints& feet, Point p) {
  bool is_complete = false;
  size_t n = 0;
  for (const tools::Footpoint& f : feet.all(p, is_complete)) n += f.kind != tools::FootKind::kEnd;
  return n;
}

// First and second derivative of a polynomial Bezier curve.
void derivatives(const tools::BezierCurve& c, double t, Point& first, Point& second) {
  std::vector<Point> level;
  for (const tools::ControlPoint& p : c.points) level.push_back({p.x, p.y, p.z});
  const auto at = [t](std::vector<Point> l) {
    for (size_t r = 1; r < l.size(); ++r)
      for (size_t i = 0; i + r < l.size(); ++i) l[i] = l[i] * (1 - t) + l[i + 1] * t;
    return l[0];
  };
  std::vector<Point> d, dd;
  for (size_t i = 0; i + 1 < level.size(); ++i)
    d.push_back((level[i + 1] - level[i]) * static_cast<double>(level.size() - 1));
  for (size_t i = 0; i + 1 < d.size(); ++i)
    dd.push_back((d[i + 1] - d[i]) * static_cast<double>(d.size() - 1));
  first = at(d), second = at(dd);
}

bool lists(const CriticalGrid& grid, Point p, size_t piece) {
  std::vector<size_t> cells;
  const Point slack{1e-6, 1e-6, 0};
  if (!grid.cells_between(p - slack, p + slack, cells)) return true;  // outside
  for (const size_t cell : cells)
    for (const uint32_t known : grid.pieces_in(cell))
      if (known == piece) return true;
  return false;
}

}  // namespace

TEST(PlanarCurvesAreFollowedAtTheTolerancePublished) {
  size_t wrong = 0;
  uint64_t pruned = 0, moves = 0;
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    const Footpoints feet(
        tools::bezier_pieces(tools::winding_curve(seed, 10 + 2 * seed, true, seed % 2 == 0)), {});
    const CriticalGrid grid(feet, 5, 0.25);
    const Followed f = follow(feet, grid, tools::wandering_path(seed, 1500, 0.002, 0, 0), {});
    wrong += f.wrong, pruned += f.counts.pruned, moves += f.counts.moves;
  }
  CHECK_EQ(wrong, 0u);
  CHECK_GT(pruned, moves / 10);
}

// Knots of multiplicity 2 and 3: curvature jumps, and corners.
TEST(CurvesWithRepeatedKnotsAreFollowed) {
  size_t wrong = 0;
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    tools::SplineCurve c = tools::winding_curve(seed, 16, true, seed % 2 == 0);
    for (size_t k = 5; k + 5 < c.knots.size(); k += 3) {
      c.knots[k + 1] = c.knots[k];
      if (seed > 4) c.knots[k - 1] = c.knots[k];
    }
    const Footpoints feet(tools::bezier_pieces(c), {});
    const CriticalGrid grid(feet, 5, 0.25);
    wrong += follow(feet, grid, tools::wandering_path(seed, 1000, 0.002, 0, 0), {}).wrong;
  }
  CHECK_EQ(wrong, 0u);
}

TEST(WithoutEndEventsFootPointsAreLost) {
  size_t wrong = 0, moves = 0;
  for (uint64_t seed = 1; seed <= 6; ++seed) {
    const Footpoints feet(
        tools::bezier_pieces(tools::winding_curve(seed, 10 + 2 * seed, true, false)), {});
    const CriticalGrid grid(feet, 5, 0.25);
    tools::TrackerOptions options;
    options.watches_ends = false;
    const Followed f = follow(feet, grid, tools::wandering_path(seed, 1500, 0.002, 0, 0), options);
    wrong += f.wrong, moves += f.moves;
  }
  CHECK_GT(wrong, moves / 200);
}

TEST(SpaceCurvesAreFollowed) {
  size_t wrong = 0;
  for (uint64_t seed = 1; seed <= 3; ++seed) {
    const Footpoints feet(tools::bezier_pieces(tools::winding_curve(seed, 14, false, seed == 2)),
                          {});
    const CriticalGrid grid(feet, 4, 0.25);
    wrong += follow(feet, grid, tools::wandering_path(seed, 1200, 0.002, -0.2, 1.2), {}).wrong;
  }
  CHECK_EQ(wrong, 0u);
}

TEST(SurfacesAreFollowed) {
  size_t wrong = 0;
  for (uint64_t seed = 1; seed <= 2; ++seed) {
    const Footpoints feet({}, tools::bezier_pieces(tools::hilly_surface(seed, 6, 0.2, seed == 2)));
    const CriticalGrid grid(feet, 4, 0.25);
    wrong += follow(feet, grid, tools::wandering_path(seed, 300, 0.002, -0.3, 0.6), {}).wrong;
  }
  CHECK_EQ(wrong, 0u);
}

TEST(TheFixedPointPredictorNeedsFewerStepsThanThePrintedOne) {
  double steps[2] = {};
  for (const tools::Predictor predictor :
       {tools::Predictor::kFixedPoint, tools::Predictor::kProjected}) {
    tools::TrackerOptions options;
    options.predictor = predictor;
    uint64_t iterations = 0, marches = 0;
    for (uint64_t seed = 1; seed <= 4; ++seed) {
      const Footpoints feet(tools::bezier_pieces(tools::winding_curve(seed, 14, true, false)), {});
      const CriticalGrid grid(feet, 5, 0.25);
      const Followed f = follow(feet, grid, tools::wandering_path(seed, 800, 0.002, 0, 0), options);
      iterations += f.counts.iterations, marches += f.counts.marches;
      CHECK_EQ(f.wrong, 0u);
    }
    steps[predictor == tools::Predictor::kProjected] =
        static_cast<double>(iterations) / static_cast<double>(marches);
  }
  CHECK_LT(steps[0], 2.6);
  CHECK_LT(steps[0] + 0.3, steps[1]);
}

// Counts of inner foot-points over short ways: the same where no critical cell is touched and no
// end's normal crossed; odd changes only at ends; changes by two only in critical cells.
TEST(CountsChangeByTwoAtTheEvoluteByOneAtEndsElseNotAtAll) {
  size_t none = 0, ends = 0, twos = 0;
  for (uint64_t seed = 1; seed <= 8; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    const Footpoints feet(tools::bezier_pieces(tools::winding_curve(seed, 12, true, seed % 2 == 0)),
                          {});
    const CriticalGrid grid(feet, 7, 0.25);
    const auto& first = feet.curves().front();
    const auto& last = feet.curves().back();
    const auto above = [](const tools::CurveSystem& c, double a, Point b, Point p) {
      return a - dot(p - c.origin, b) > 0;
    };
    tools::Random random(seed);
    for (int k = 0; k < 600; ++k) {
      const double side = grid.side_m() * 0.99;
      const Point p =
          grid.low_m() + Point{0.005 + random.uniform() * side, 0.005 + random.uniform() * side, 0};
      const Point q = p + Point{random.between(-1, 1), random.between(-1, 1), 0} * 0.003;
      std::vector<size_t> cells;
      if (!grid.cells_between(p, q, cells)) continue;
      bool is_critical = false;
      for (const size_t cell : cells) is_critical |= !grid.pieces_in(cell).empty();
      const int crossed = (above(first, first.a.c.front(), first.b.c.front(), p) !=
                           above(first, first.a.c.front(), first.b.c.front(), q)) +
                          (above(last, last.a.c.back(), last.b.c.back(), p) !=
                           above(last, last.a.c.back(), last.b.c.back(), q));
      const auto change = static_cast<int>(inner(feet, q)) - static_cast<int>(inner(feet, p));
      CHECK_EQ(std::abs(change) % 2, crossed % 2);
      if (!is_critical) CHECK_LE(std::abs(change), crossed);
      none += change == 0, ends += std::abs(change) == 1, twos += std::abs(change) == 2;
    }
  }
  CHECK_GT(none, 4000u);
  CHECK_GT(ends, 5u);
  CHECK_GT(twos, 20u);
}

TEST(TheCriticalCellsCoverTheEvoluteAndKeepToIt) {
  for (uint64_t seed = 1; seed <= 4; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    const Footpoints feet(tools::bezier_pieces(tools::winding_curve(seed, 12, true, false)), {});
    const CriticalGrid grid(feet, 7, 0.25);
    std::vector<Point> evolute;
    for (size_t k = 0; k < feet.curves().size(); ++k) {
      Point ends[2];
      for (int i = 0; i <= 4000; ++i) {
        Point d, dd;
        const tools::BezierCurve& c = feet.curves()[k].piece;
        derivatives(c, i / 4000.0, d, dd);
        const double turn = d.x * dd.y - d.y * dd.x;  // C + N / kappa, of a planar curve
        const Point centre = point_at(c, i / 4000.0) + Point{-d.y, d.x, 0} * (dot(d, d) / turn);
        CHECK(lists(grid, centre, k));
        evolute.push_back(centre);
        if (i % 4000 == 0) ends[i / 4000] = centre;
      }
    }
    // Every critical cell is beside the evolute. Derivatives of a C2 spline have no jump at joints.
    const double cell_m = grid.side_m() / 128;
    size_t astray = 0, marked = 0;
    for (size_t cell = 0; cell < grid.cells(); ++cell) {
      if (grid.pieces_in(cell).empty()) continue;
      Point low, high;
      grid.box_of(cell, low, high);
      const Point middle = (low + high) * 0.5;
      ++marked;
      bool is_near = false;
      for (const Point& e : evolute) is_near |= tools::length(e - middle) < 2.5 * cell_m;
      astray += !is_near;
    }
    CHECK_GT(marked, 50u);
    CHECK_LE(astray, marked / 10);  // the evolute runs away between samples near inflections
  }
}

TEST(TheCriticalCellsOfASurfaceCoverBothFocalSheets) {
  const tools::SplineSurface s = tools::hilly_surface(3, 5, 0.2, false);
  const Footpoints feet({}, tools::bezier_pieces(s));
  const CriticalGrid grid(feet, 4, 0.25);
  size_t inside = 0;
  for (size_t k = 0; k < feet.patches().size(); ++k) {
    for (int j = 1; j < 40; ++j) {
      for (int i = 1; i < 40; ++i) {
        const double u = i / 40.0, v = j / 40.0, e = 1e-3;
        const auto at = [&](double a, double b) {
          return feet.patches()[k].point(u + a * e, v + b * e);
        };
        const Point o = at(0, 0), su = (at(1, 0) - at(-1, 0)) * (0.5 / e),
                    sv = (at(0, 1) - at(0, -1)) * (0.5 / e),
                    suu = (at(1, 0) + at(-1, 0) - o * 2) * (1 / e / e),
                    svv = (at(0, 1) + at(0, -1) - o * 2) * (1 / e / e),
                    suv = (at(1, 1) + at(-1, -1) - at(1, -1) - at(-1, 1)) * (0.25 / e / e);
        const Point n = cross(su, sv) * (1 / tools::length(cross(su, sv)));
        const double E = dot(su, su), F = dot(su, sv), G = dot(sv, sv);
        const double L = dot(suu, n), M = dot(suv, n), N = dot(svv, n);
        const double gauss = (L * N - M * M) / (E * G - F * F);
        const double mean = (E * N - 2 * F * M + G * L) / (2 * (E * G - F * F));
        const double root = std::sqrt(std::fmax(0, mean * mean - gauss));
        for (const double bend : {mean + root, mean - root}) {
          const Point centre = o + n * (1 / bend);
          std::vector<size_t> cells;
          const Point slack{1e-4, 1e-4, 1e-4};  // of the differences above
          if (!grid.cells_between(centre - slack, centre + slack, cells)) continue;
          ++inside;
          bool is_listed = false;
          for (const size_t cell : cells)
            for (const uint32_t piece : grid.pieces_in(cell)) is_listed |= piece == k;
          CHECK(is_listed);
        }
      }
    }
  }
  CHECK_GT(inside, 1000u);
}
