// Smooth curves: the closest point of cubic pieces against a oracle that looks everywhere in
// double, and what a hand feels that goes along one.
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "curve/hard_curves.hpp"
#include "firmtouch/curve/guided_point.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;
using curve_test::Baked;
using curve_test::point;
using curve_test::Points;

struct Wide {
  double x, y, z;
};
Wide wide(math::Vec3 v) { return {double{v.x}, double{v.y}, double{v.z}}; }
Wide operator+(Wide a, Wide b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Wide operator-(Wide a, Wide b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Wide operator*(Wide a, double s) { return {a.x * s, a.y * s, a.z * s}; }
double size(Wide a) { return std::hypot(a.x, a.y, a.z); }

// The pieces as FORMAT.md has them, in double, from the samples alone.
class Oracle {
 public:
  explicit Oracle(const Baked& baked) {
    const Points& s = baked.samples;
    const size_t last = s.size() - 1;
    std::vector<Wide> slope(s.size());
    for (size_t i = 0; i <= last; ++i) {
      const bool is_end = i == 0 || i == last;
      if (is_end && !baked.view.is_closed()) {
        const Wide only = i == 0 ? wide(s[1]) - wide(s[0]) : wide(s[last]) - wide(s[last - 1]);
        slope[i] = only * (1 / size(only));
        continue;
      }
      const Wide before = is_end ? wide(s[last]) - wide(s[last - 1]) : wide(s[i]) - wide(s[i - 1]);
      const Wide after = is_end ? wide(s[1]) - wide(s[0]) : wide(s[i + 1]) - wide(s[i]);
      const double b = size(before), a = size(after);
      slope[i] = (before * (a / b) + after * (b / a)) * (1 / (a + b));
    }
    for (size_t i = 0; i < last; ++i) {
      const Wide p = wide(s[i]), q = wide(s[i + 1]);
      const double third = size(q - p) / 3;
      pieces_.push_back({p, p + slope[i] * third, q - slope[i + 1] * third, q});
    }
  }

  static Wide at(const Wide (&b)[4], double t) {
    const double u = 1 - t;
    return b[0] * (u * u * u) + b[1] * (3 * u * u * t) + b[2] * (3 * u * t * t) +
           b[3] * (t * t * t);
  }
  Wide at(size_t piece, double t) const { return at(pieces_[piece].b, t); }

  double distance(math::Vec3 p) const {
    const Wide q = wide(p);
    double least = HUGE_VAL;
    for (const Piece& piece : pieces_) {
      constexpr int kSteps = 24;
      double near[kSteps + 1];
      for (int i = 0; i <= kSteps; ++i) near[i] = size(at(piece.b, 1.0 * i / kSteps) - q);
      for (int i = 0; i <= kSteps; ++i) {
        least = std::min(least, near[i]);
        const bool is_low = i > 0 && i < kSteps && near[i] <= near[i - 1] && near[i] <= near[i + 1];
        const bool is_end =
            (i == 0 && near[0] <= near[1]) || (i == kSteps && near[kSteps] <= near[kSteps - 1]);
        if (is_low || is_end) least = std::min(least, refined(piece.b, q, i, kSteps));
      }
    }
    return least;
  }

 private:
  struct Piece {
    Wide b[4];
  };
  static double refined(const Wide (&b)[4], Wide q, int i, int steps) {
    double low = std::max(0.0, (i - 1.0) / steps), high = std::min(1.0, (i + 1.0) / steps);
    for (int k = 0; k < 60; ++k) {
      const double a = low + (high - low) * 0.382, c = low + (high - low) * 0.618;
      if (size(at(b, a) - q) < size(at(b, c) - q))
        high = c;
      else
        low = a;
    }
    return size(at(b, (low + high) / 2) - q);
  }
  std::vector<Piece> pieces_;
};

// Of max(diagonal, distance), and of the longest piece.
double room(const Baked& baked, double truth) {
  const double scale = std::max(double{baked.view.head().diagonal_m}, truth);
  return 1e-6 * scale + 8e-6 * double{baked.view.head().longest_half_m};
}

std::vector<curve_test::NamedCurve> curves() {
  std::vector<curve_test::NamedCurve> all;
  for (const curve_test::NamedCurve& named : curve_test::hard_curves())
    if (Baked(named.points, true).report.problem.empty()) all.push_back(named);
  return all;
}

uint32_t queries_a_curve() { return std::getenv("FIRMTOUCH_LONG") != nullptr ? 5000 : 150; }

Points ring(int count) {
  Points points;
  for (int i = 0; i < count; ++i) {
    const double k = 2 * 3.14159265358979 * i / count;
    points.push_back(point(0.05 * std::cos(k), 0.05 * std::sin(k), 0.01 * std::sin(3 * k)));
  }
  points.push_back(points.front());
  return points;
}

}  // namespace

TEST(SmoothCurve_IsBakedAndProven_OfHardSamples) {
  size_t refused = 0;
  for (const curve_test::NamedCurve& named : curve_test::hard_curves()) {
    const Baked baked(named.points, true);
    test::note(named.name.c_str(), 0);
    if (!baked.report.problem.empty()) ++refused;
    CHECK(baked.report.problem.empty() ||
          baked.report.problem.find("too few samples") != std::string::npos);
  }
  CHECK_LE(refused, 1u);
}

TEST(ClosestPoint_OfCubicPieces_EqualsDenseOracle) {
  double worst = 0;
  size_t in_doubt = 0, all = 0;
  for (const curve_test::NamedCurve& named : curves()) {
    const Baked baked(named.points, true);
    const Oracle oracle(baked);
    test::note(named.name.c_str(), 0);
    curve::Hint warm;
    for (const math::Vec3& p : curve_test::queries(baked.samples, queries_a_curve(), 41)) {
      const double truth = oracle.distance(p);
      curve::Hint cold;
      const auto alone = closest_point(baked.view, p, query::kUnlimited, cold);
      const auto next = closest_point(baked.view, p, query::kUnlimited, warm);
      for (const curve::Closest& found : {alone, next}) {
        const double reported = double{found.distance_m}, most = room(baked, truth);
        ++all;
        CHECK_LE(double{found.certificate.lower_m}, truth * (1 + 1e-9));
        CHECK_GE(reported, truth - most);
        CHECK_LE(std::abs(size(wide(p) - wide(found.point_m)) - reported),
                 most + 2e-7 * size(wide(p)));
        if (!found.certificate.exact) {
          ++in_doubt;
          continue;
        }
        CHECK_LE(reported, truth + most);
        CHECK_GE(double{found.certificate.lower_m}, truth - 2 * most);
        worst = std::max(
            worst, (reported - truth) / std::max(double{baked.view.head().diagonal_m}, truth));
      }
    }
  }
  std::printf("      worst %.2g of max(diagonal, distance); %zu of %zu in doubt\n", worst, in_doubt,
              all);
  CHECK_LE(in_doubt * 100, all);
}

TEST(Certificate_Holds_UnderEveryBudgetOfASmoothCurve) {
  for (const curve_test::NamedCurve& named : curves()) {
    const Baked baked(named.points, true);
    const Oracle oracle(baked);
    test::note(named.name.c_str(), 0);
    curve::Hint warm;
    curve::Following following;
    for (const math::Vec3& p : curve_test::queries(baked.samples, 8, 43)) {
      const double truth = oracle.distance(p);
      for (uint32_t work = 0; work < 400; work += 1 + work / 32) {
        test::note("work", work);
        const curve::Hold hold{0.1f * baked.view.head().length_m, 1e3f};
        const auto tick = follow(baked.view, p, hold, {work}, following);
        CHECK_LE(double{tick.closest.certificate.lower_m}, truth * (1 + 1e-9));
        CHECK_GE(double{tick.closest.distance_m}, truth - room(baked, truth));
        CHECK_LE(tick.closest.certificate.work, std::max(work, 2u));
        curve::Neighbour memory[10];
        const auto tied = nearest_constraint(baked.view, p, {}, {memory, 10}, {work});
        CHECK_LE(double{tied.closest.certificate.lower_m}, truth * (1 + 1e-9));
        CHECK_LE(tied.closest.certificate.work, std::max(work, 1u));
        const curve::ArcPenalty penalty{0.1f * baked.view.head().diagonal_m, 0.4f, true};
        curve::Hint cold, held;
        const auto found = closest_point(baked.view, p, {work}, cold);
        const auto next = closest_point(baked.view, p, {work}, warm);
        const auto guided = guided_point(baked.view, p, penalty, {work}, held);
        for (const curve::Closest& c : {found, next}) {
          CHECK_LE(double{c.certificate.lower_m}, truth * (1 + 1e-9));
          CHECK_LE(c.certificate.work, std::max(work, 1u));
          CHECK_LE(c.certificate.steps, c.certificate.work);
          if (c.certificate.exact) CHECK_LE(double{c.distance_m}, truth + room(baked, truth));
          CHECK_GE(double{c.distance_m}, truth - room(baked, truth));
        }
        CHECK_LE(guided.closest.certificate.lower_m, guided.cost_m);
        CHECK_GE(double{guided.closest.distance_m}, truth - room(baked, truth));
      }
    }
  }
}

// A hand 3 mm beside a guide of coarse samples, at 1 kHz and 100 mm/s: the force's step from tick
// to tick, less that of a true circle's.
TEST(Guide_HasNoCorners_OnCubicPieces) {
  for (const double aside : {0.003, -0.003}) {
    double steps[2] = {};
    for (const bool is_smooth : {false, true}) {
      const Baked baked(ring(40), is_smooth);
      CHECK(baked.report.problem.empty());
      curve::Following following;
      math::Vec3 before{};
      double worst = 0;
      for (int i = 0; i < 4000; ++i) {
        const double k = i * 1e-4 / 0.053;
        const math::Vec3 p = point((0.05 + aside) * std::cos(k), (0.05 + aside) * std::sin(k),
                                   0.01 * std::sin(3 * k));
        const auto found = follow(baked.view, p, {0.03f, 0.02f}, query::kUnlimited, following);
        const math::Vec3 c = found.closest.point_m;
        const math::Vec3 pull = {c.x - p.x, c.y - p.y, c.z - p.z};
        if (i > 0) worst = std::max(worst, size(wide(pull) - wide(before)) / size(wide(pull)));
        before = pull;
      }
      steps[is_smooth ? 1 : 0] = worst;
    }
    std::printf("      %+.0f mm: steps of the force %.2f %% (straight), %.2f %% (cubic)\n",
                aside * 1e3, 100 * steps[0], 100 * steps[1]);
    CHECK_LE(steps[1], 0.01);
    CHECK(aside > 0 || steps[0] > 0.05);  // inside, straight pieces jump at every sample
  }
}

TEST(Tangent_StaysTheSame_AtASample) {
  const Baked baked(ring(40), true);
  curve::Hint hint;
  for (uint32_t i = 1; i + 1 < baked.samples.size(); ++i) {
    const Oracle oracle(baked);
    const Wide a = oracle.at(i - 1, 0.9999), b = oracle.at(i, 0.0001);
    const auto before = closest_point(baked.view, point(a.x, a.y, a.z), query::kUnlimited, hint);
    const auto after = closest_point(baked.view, point(b.x, b.y, b.z), query::kUnlimited, hint);
    CHECK_LE(size(wide(before.tangent) - wide(after.tangent)), 1e-3);
  }
}
