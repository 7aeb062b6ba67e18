// The point of a guide of the least distance + penalty, against dense sampling with refinement in
// double: of the file's own curve, and of the cost as it is returned.
#include "firmtouch/spline/closest_point.hpp"
#include "firmtouch/spline/guide/min_cost.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <vector>

#include "firmtouch/spline/guide/arc.hpp"
#include "firmtouch/spline/guide/chain.hpp"
#include "harness/test.hpp"
#include "spline/baked_guide.hpp"
#include "spline/random_splines.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using math::Vec3;
using query::Budget;
using query::kUnlimited;
using spline::CurveHint;
using spline_test::Guide;

int queries_a_curve() { return std::getenv("FIRMTOUCH_LONG") != nullptr ? 5000 : 96; }

// The least of a function over an interval: samples, samples again about the low ones, and a
// section about the low ones of those.
double least_of(double low, double high, int samples, const std::function<double(double)>& f,
                bool is_again = false) {
  std::vector<double> values;
  for (int i = 0; i <= samples; ++i) values.push_back(f(low + (high - low) * i / samples));
  const double step = (high - low) / samples;
  double least = HUGE_VAL;
  for (int i = 0; i <= samples; ++i) {
    const size_t at = static_cast<size_t>(i);
    const bool is_low =
        (i == 0 || values[at] <= values[at - 1]) && (i == samples || values[at] <= values[at + 1]);
    if (!is_low) continue;
    double a = std::max(low, low + step * (i - 1)), b = std::min(high, low + step * (i + 1));
    if (!is_again) {
      least = std::min(least, least_of(a, b, 16, f, true));
      continue;
    }
    for (int turn = 0; turn < 60; ++turn) {
      const double first = a + 0.381966 * (b - a), second = b - 0.381966 * (b - a);
      (f(first) < f(second) ? b : a) = f(first) < f(second) ? second : first;
    }
    least = std::min({least, values[at], f(0.5 * (a + b))});
  }
  return least;
}

// Lengths along the file's curves, one after the other, from their own knots.
class Lengths {
 public:
  explicit Lengths(const tools::SplineModel& model) {
    double sum = 0;
    for (const tools::SplineCurve& c : model.curves) {
      Table table{sum, sum, {}, {}};
      for (size_t k = 0; k + 1 < c.knots.size(); ++k) {
        const double low = std::max(c.knots[k], c.t0), high = std::min(c.knots[k + 1], c.t1);
        if (!(high > low)) continue;
        tools::Point before = point_at(c, low);
        for (int i = 0; i <= kSteps; ++i) {
          const double t = low + (high - low) * i / kSteps;
          const tools::Point next = point_at(c, t);
          sum += length(next - before);
          before = next;
          table.at.push_back(t);
          table.arcs.push_back(sum);
        }
      }
      table.last = sum;
      tables_.push_back(table);
    }
  }
  double at(size_t curve, double t) const {
    const Table& table = tables_[curve];
    const auto above = std::upper_bound(table.at.begin(), table.at.end(), t);
    const auto i = std::min(static_cast<size_t>(above - table.at.begin()), table.at.size() - 1);
    if (i == 0) return table.first;
    const double wide = table.at[i] - table.at[i - 1];
    const double share = wide > 0 ? std::min((t - table.at[i - 1]) / wide, 1.0) : 1.0;
    return table.arcs[i - 1] + (table.arcs[i] - table.arcs[i - 1]) * share;
  }
  // By lengths, where each curve is a chain of its own.
  double change(size_t from_curve, double from, size_t to_curve, double to, bool is_closed) const {
    const double way = std::fabs(to - from);
    if (from_curve != to_curve || !is_closed) return way;
    return std::min(way, tables_[to_curve].last - tables_[to_curve].first - way);
  }

 private:
  static constexpr int kSteps = 2000;
  struct Table {
    double first, last;
    std::vector<double> at, arcs;
  };
  std::vector<Table> tables_;
};

struct Was {
  uint32_t piece;
  float s;
};

double apart(const tools::Point& a, const tools::Point& b) { return length(a - b); }

// Of the file's curve.
double cost_by_file(const Guide& g, const Lengths& lengths, const tools::Point& p, double per_m,
                    const Was& was) {
  const spline::Piece& piece = g.view.pieces()[was.piece];
  const size_t own = piece.entity;
  const double from =
      lengths.at(own, static_cast<double>(piece.middle_u) +
                          static_cast<double>(piece.half_u) * static_cast<double>(was.s));
  double least = HUGE_VAL;
  for (size_t i = 0; i < g.model.curves.size(); ++i) {
    const tools::SplineCurve& c = g.model.curves[i];
    const bool is_closed = apart(point_at(c, c.t0), point_at(c, c.t1)) < 1e-9;
    for (size_t k = 0; k + 1 < c.knots.size(); ++k) {
      const double low = std::max(c.knots[k], c.t0), high = std::min(c.knots[k + 1], c.t1);
      if (!(high > low)) continue;
      const double found = least_of(low, high, 60, [&](double t) {
        return apart(point_at(c, t), p) +
               per_m * lengths.change(own, from, i, lengths.at(i, t), is_closed);
      });
      least = std::min(least, found);
    }
  }
  return least;
}

// A stored piece in double, beside the lengths that are returned.
double cost_as_reported(const Guide& g, const tools::Point& p, float per_m, const Was& was) {
  const spline::Round round = spline::round_of(g.guide, was.piece);
  const float from_m = spline::Arcs(g.guide).at_m(was.piece, was.s);
  double least = HUGE_VAL;
  for (uint32_t i = 0; i < g.view.pieces().size(); ++i) {
    const spline::Piece& piece = g.view.pieces()[i];
    const auto cost = [&](double s) {
      const uint32_t stride = piece.is_rational != 0 ? 4 : 3;
      double sum[4] = {0, 0, 0, 0};
      for (uint32_t k = piece.degree_u + 1u; k-- > 0;)
        for (uint32_t d = 0; d < stride; ++d)
          sum[d] = sum[d] * s +
                   static_cast<double>(g.view.coefficients()[piece.coefficients + k * stride + d]);
      const double w = stride == 4 ? sum[3] : 1;
      const tools::Point at{sum[0] / w + static_cast<double>(piece.origin_m[0]),
                            sum[1] / w + static_cast<double>(piece.origin_m[1]),
                            sum[2] / w + static_cast<double>(piece.origin_m[2])};
      const float to_m = spline::Arcs(g.guide).at_m(i, static_cast<float>(s));
      return apart(at, p) +
             static_cast<double>(per_m) *
                 std::fabs(static_cast<double>(spline::change_of_arc_m(round, from_m, i, to_m)));
    };
    if (i == was.piece) {
      const double kink = static_cast<double>(was.s);
      least = std::min({least, least_of(-1, kink, 40, cost), least_of(kink, 1, 40, cost)});
    } else {
      least = std::min(least, least_of(-1, 1, 60, cost));
    }
  }
  return least;
}

tools::SplineCurve closed(tools::SplineCurve curve) {
  const size_t order = static_cast<size_t>(curve.degree) + 1;
  for (size_t i = 0; i < order; ++i) {  // clamped, so that its ends are its first and last points
    curve.knots[i] = curve.t0;
    curve.knots[curve.knots.size() - 1 - i] = curve.t1;
  }
  curve.points.back() = curve.points.front();
  return curve;
}

std::vector<std::vector<tools::SplineCurve>> curves() {
  std::vector<std::vector<tools::SplineCurve>> all = {{spline_test::hairpin()},
                                                      {spline_test::eight()}};
  tools::Random random(4400);
  for (int degree = 1; degree <= 5; ++degree) {
    all.push_back({spline_test::random_curve(random, degree, degree > 1 ? 2 : 1)});
    all.push_back({closed(spline_test::random_curve(random, degree, 1))});
  }
  all.push_back({spline_test::random_curve(random, 3, 1), closed(spline_test::eight()),
                 spline_test::random_curve(random, 2, 1)});
  return all;
}

Was any_place(tools::Random& random, const Guide& g, int i) {
  Was was{random.below(g.view.pieces().size()), static_cast<float>(random.between(-1, 1))};
  if (i % 7 == 0) was.s = i % 2 == 0 ? -1.0f : 1.0f;
  return was;
}

}  // namespace

TEST(TheLeastCostOfAGuideAgainstDenseSampling) {
  constexpr double kPerMetre[] = {0.003, 0.03, 0.1, 0.3, 1, 4};
  uint64_t steps = 0, queries = 0;
  uint32_t worst_steps = 0, seed = 0;
  double worst = 0;
  for (const auto& curves_of_file : curves()) {
    const Guide g(curves_of_file);
    const Lengths lengths(g.model);
    const double extent = static_cast<double>(g.view.head().extent_m);
    firmtouch::test::note("curve", seed++);
    tools::Random random(seed);
    for (int i = 0; i < queries_a_curve(); ++i) {
      firmtouch::test::note("query", i);
      const double per_m = kPerMetre[i % 6];
      Was was = any_place(random, g, i);
      tools::Point p{random.between(-1.5, 1.5) * extent / 2, random.between(-1.5, 1.5) * extent / 2,
                     random.between(-0.3, 0.3) * extent};
      if (i % 4 == 0) {  // beside the curve, where a guide is
        const Was near = any_place(random, g, i);
        const Vec3 on = spline::position_of(g.view, near.piece, near.s);
        p = {static_cast<double>(on.x) + random.between(-0.01, 0.01) * extent,
             static_cast<double>(on.y) + random.between(-0.01, 0.01) * extent,
             static_cast<double>(on.z) + random.between(-0.01, 0.01) * extent};
        if (i % 8 == 0) {  // and came from
          const double s = static_cast<double>(near.s) + random.between(-0.2, 0.2);
          was = {near.piece, static_cast<float>(std::clamp(s, -1.0, 1.0))};
        }
      }
      const Vec3 q = tools::to_vec3(p);
      p = {static_cast<double>(q.x), static_cast<double>(q.y), static_cast<double>(q.z)};
      const auto weight_m = static_cast<float>(per_m * static_cast<double>(g.guide.length_m()));
      CurveHint cold;
      const spline::Closest nearest = closest_point(g.view, q, kUnlimited, cold);
      const spline::LeastCost found =
          min_cost(g.guide, q, {weight_m, was.piece, was.s}, nearest, kUnlimited);
      CHECK(found.certificate.exact);
      const double reported = static_cast<double>(found.cost_m),
                   lower = static_cast<double>(found.certificate.lower_m);
      const double own = cost_as_reported(g, p, weight_m / g.guide.length_m(), was);
      const double room = (g.view.head().is_rational != 0 ? 1e-6 : 4e-7) * extent +
                          1e-6 * static_cast<double>(weight_m) + 2e-6 * own;
      CHECK_LE(std::fabs(reported - own), room);
      CHECK_LE(lower, own + 1e-15);
      CHECK_GE(lower, own - room);
      const uint32_t most = 2 + random.below(40);
      const spline::LeastCost cut =
          min_cost(g.guide, q, {weight_m, was.piece, was.s}, nearest, Budget{most});
      CHECK_LE(cut.certificate.steps, most);
      CHECK_LE(static_cast<double>(cut.certificate.lower_m), own + 1e-15);
      CHECK_GE(static_cast<double>(cut.cost_m), own - room);
      if (cut.certificate.exact) CHECK_LE(static_cast<double>(cut.cost_m), own + room);
      const double by_file = cost_by_file(g, lengths, p, per_m, was);
      CHECK_LE(std::fabs(reported - by_file), room + 4e-5 * static_cast<double>(weight_m));
      worst = std::max(worst, std::fabs(reported - own) / room);
      steps += found.certificate.steps;
      worst_steps = std::max(worst_steps, found.certificate.steps);
      ++queries;
    }
  }
  std::printf("      steps %.1f, at most %u; %.2f of what may be lost\n",
              static_cast<double>(steps) / static_cast<double>(queries), worst_steps, worst);
}
