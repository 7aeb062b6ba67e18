// Searches that are wrong in known ways, planted here and checked as the real one is: the oracle
// finds them out, and the real one is right on the same queries.
#include <cmath>
#include <vector>

#include "bake/spline/bake_spline.hpp"
#include "firmtouch/spline/closest_point.hpp"
#include "firmtouch/spline/proof/opening.hpp"
#include "harness/test.hpp"
#include "spline/baked_model.hpp"
#include "spline/exact_distance.hpp"
#include "spline/random_splines.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using spline_test::ExactDistance;
using tools::Point;

// Newton from the middle of each of `leaves` parts of a piece, ended where it stands still.
double by_convergence(const std::vector<tools::BezierCurve>& pieces, const Point& p, int leaves) {
  double best2 = HUGE_VAL;
  for (const tools::BezierCurve& piece : pieces)
    for (int leaf = 0; leaf < leaves; ++leaf) {
      const double low = 1.0 * leaf / leaves, high = 1.0 * (leaf + 1) / leaves, h = 1e-4;
      const auto squared = [&](double t) {
        const Point off = point_at(piece, t) - p;
        return dot(off, off);
      };
      double t = 0.5 * (low + high);
      for (int turn = 0; turn < 30; ++turn) {
        const double slope = (squared(t + h) - squared(t - h)) / (2 * h);
        const double bend = (squared(t + h) - 2 * squared(t) + squared(t - h)) / (h * h);
        double to = bend > 0 ? t - slope / bend : slope > 0 ? low : high;
        to = std::min(high, std::max(low, to));
        while (std::fabs(to - t) > 1e-9 && squared(to) > squared(t)) to = t + 0.25 * (to - t);
        if (!(std::fabs(to - t) > 1e-9)) break;
        t = to;
      }
      best2 = std::min(best2, squared(t));
    }
  return std::sqrt(best2);
}

// On a surface: Newton on each of 4 x 4 parts of a patch. A step that leaves the part is cut off on
// each axis by itself, or the axis that is pushed against its end is left out and the step made
// anew.
double on_patches(const std::vector<tools::BezierPatch>& patches, const Point& p, bool is_clamped) {
  double best2 = HUGE_VAL;
  const double h = 1e-4;
  for (const tools::BezierPatch& patch : patches)
    for (int leaf = 0; leaf < 16; ++leaf) {
      const double low[2] = {0.25 * (leaf % 4), 0.25 * (leaf / 4)};
      const auto squared = [&](const double(&at)[2]) {
        const Point off = point_at(patch, at[0], at[1]) - p;
        return dot(off, off);
      };
      double at[2] = {low[0] + 0.125, low[1] + 0.125};
      for (int turn = 0; turn < 40; ++turn) {
        const auto beside = [&](double du, double dv) {
          const double to[2] = {at[0] + du * h, at[1] + dv * h};
          return squared(to);
        };
        const double now = squared(at);
        const double g[2] = {(beside(1, 0) - beside(-1, 0)) / (2 * h),
                             (beside(0, 1) - beside(0, -1)) / (2 * h)};
        const double a = (beside(1, 0) - 2 * now + beside(-1, 0)) / (h * h);
        const double c = (beside(0, 1) - 2 * now + beside(0, -1)) / (h * h);
        const double b =
            (beside(1, 1) - beside(1, -1) - beside(-1, 1) + beside(-1, -1)) / (4 * h * h);
        const double det = a * c - b * b;
        double step[2] = {-g[0], -g[1]};
        if (a > 0 && det > 0) {
          step[0] = (b * g[1] - c * g[0]) / det;
          step[1] = (b * g[0] - a * g[1]) / det;
        }
        if (!is_clamped)
          for (int k = 0; k < 2; ++k) {
            const bool at_low = at[k] <= low[k] && g[k] > 0;
            const bool at_high = at[k] >= low[k] + 0.25 && g[k] < 0;
            if (!at_low && !at_high) continue;
            const double other = k == 0 ? c : a;
            step[k] = 0;
            step[1 - k] = other > 0 ? -g[1 - k] / other : -g[1 - k];
          }
        bool has_moved = false;
        for (double share = 1; share > 1e-7 && !has_moved; share *= 0.5) {
          double to[2];
          for (int k = 0; k < 2; ++k)
            to[k] = std::min(low[k] + 0.25, std::max(low[k], at[k] + share * step[k]));
          has_moved = squared(to) < now - 1e-15;
          if (has_moved) at[0] = to[0], at[1] = to[1];
          if (is_clamped) break;  // as a plain Newton does
        }
        if (!has_moved) break;
      }
      best2 = std::min(best2, squared(at));
    }
  return std::sqrt(best2);
}

struct Counts {
  int queries = 0, first = 0, second = 0, real = 0;
};

bool is_wrong(double reported, double truth, double extent_m) {
  return std::fabs(reported - truth) > 1e-6 * extent_m + 6e-7 * truth;
}

template <class First, class Second>
void count(const tools::SplineModel& model, uint32_t seed, int queries, Counts& counts, First first,
           Second second) {
  const spline_test::BakedModel baked(model);
  const tools::SplineReport& report = baked.report;
  const spline::View& view = baked.view;
  CHECK(view.is_open());
  const ExactDistance exact(model);
  tools::Random random(seed);
  spline::Hint hint;
  for (int i = 0; i < queries; ++i) {
    const Point p = tools::to_point(tools::to_vec3(
        {random.between(-1.3, 1.3), random.between(-1.3, 1.3), random.between(-1.3, 1.3)}));
    const double truth = static_cast<double>(exact.distance(p).hi);
    const spline::Closest c = closest_point(view, tools::to_vec3(p), query::kUnlimited, hint);
    ++counts.queries;
    counts.real += is_wrong(static_cast<double>(c.distance_m), truth, report.extent_m) ? 1 : 0;
    counts.first += is_wrong(first(p), truth, report.extent_m) ? 1 : 0;
    counts.second += is_wrong(second(p), truth, report.extent_m) ? 1 : 0;
  }
}

}  // namespace

TEST(OneLeafASegmentClosedByConvergenceWouldBeFoundOut) {
  Counts counts;
  for (uint32_t seed = 0; seed < 6; ++seed) {
    tools::Random random(seed + 60);
    tools::SplineModel model;
    model.curves.push_back(spline_test::random_curve(random, 3, 1));
    const auto pieces = bezier_pieces(model.curves[0]);
    count(
        model, seed, 50, counts, [&](const Point& p) { return by_convergence(pieces, p, 1); },
        [&](const Point& p) { return by_convergence(pieces, p, 8); });
  }
  CHECK_EQ(counts.real, 0);
  CHECK_GE(counts.first, counts.queries / 100);  // one leaf a segment
  CHECK_LE(counts.second, counts.first / 3);     // eight: rarely, but nothing says when
}

TEST(StepClampedInsteadOfProjected_IsDetected) {
  Counts counts;
  for (uint32_t seed = 0; seed < 2; ++seed) {
    tools::Random random(seed + 80);
    tools::SplineModel model;
    model.surfaces.push_back(spline_test::random_surface(random, 3, 3, 1));
    const auto patches = bezier_pieces(model.surfaces[0]);
    count(
        model, seed, 12, counts, [&](const Point& p) { return on_patches(patches, p, true); },
        [&](const Point& p) { return on_patches(patches, p, false); });
  }
  CHECK_EQ(counts.real, 0);
  CHECK_GE(counts.first, counts.queries / 10);  // clamped
  CHECK_LE(counts.second, counts.first / 2);    // projected
}
