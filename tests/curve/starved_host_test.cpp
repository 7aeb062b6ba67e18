// Queries of straight curves that run out of work, against every segment in double.
#include "curve/hard_curves.hpp"
#include "firmtouch/curve/guided_point.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;
using curve_test::Baked;
using query::Budget;

constexpr uint32_t kMaxWork = 240;
constexpr double kLost = 4e-7;  // of max(diagonal, distance)

void check(const Baked& baked, double truth, uint32_t work, const curve::Closest& found) {
  const double scale = std::max(double{baked.view.head().diagonal_m}, truth);
  const query::Certificate& certificate = found.certificate;
  CHECK_LE(double{certificate.lower_m}, truth * (1 + 1e-15));
  CHECK_GE(double{found.distance_m}, truth - kLost * scale);
  if (certificate.exact) CHECK_LE(double{found.distance_m}, truth + kLost * scale);
  // What was left would have been used.
  if (!certificate.exact) CHECK_EQ(certificate.work, std::max(work, 1u));
  CHECK_LE(certificate.work, std::max(work, 1u));
  CHECK_LE(certificate.steps, certificate.work);
}

// By every budget from 0 on, each with a hint of its own.
template <class Query>
void starve(uint32_t seed, const Query& query) {
  for (const curve_test::NamedCurve& named : curve_test::hard_curves()) {
    const Baked baked(named.points);
    test::note(named.name.c_str(), 0);
    std::vector<math::Vec3> points = curve_test::queries(baked.samples, 8, seed);
    const float far_m = 40.0f * baked.view.head().diagonal_m;
    points.push_back(points.back() + math::Vec3{far_m, -far_m, far_m});
    for (uint32_t work = 0; work <= kMaxWork; ++work) {
      test::note("work", work);
      curve::Following state;
      for (const math::Vec3& p : points)
        query(baked, p, curve_test::brute_distance(baked.samples, p), work, state);
    }
  }
}

}  // namespace

TEST(StarvedQuery_StaysTrue_AtEveryBudget) {
  starve(71, [](const Baked& baked, math::Vec3 p, double truth, uint32_t work,
                curve::Following& state) {
    curve::Hint cold;
    check(baked, truth, work, closest_point(baked.view, p, Budget{work}, cold));
    check(baked, truth, work, closest_point(baked.view, p, Budget{work}, state.hint));
  });
}

// From beyond the grid a warm search begins anew; what it used until then counts, too. All segments
// of a curve that jumps between clusters are near.
TEST(StarvedQuery_BeyondTheGrid_CountsAllOfItsWork) {
  std::mt19937 random(5);
  const auto about = [&](double size) { return size * (2 * curve_test::uniform(random) - 1); };
  curve_test::Points centres, points;
  for (int i = 0; i < 6; ++i) centres.push_back(curve_test::point(about(1), about(1), about(1)));
  for (int i = 0; i < 4000; ++i) {
    const math::Vec3& c = centres[random() % centres.size()];
    points.push_back(c + curve_test::point(about(1e-3), about(1e-3), about(1e-3)));
  }
  const Baked baked(points);
  CHECK(baked.view.is_open());
  uint32_t ran_out = 0;
  for (uint32_t work = 1; work <= 4 * kMaxWork; work += 3) {
    test::note("work", work);
    curve::Hint hint;
    for (int i = 0; i < 8; ++i) {
      const math::Vec3 p = curve_test::point(about(1.6), about(1.6), about(1.6));
      const curve::Closest found = closest_point(baked.view, p, Budget{work}, hint);
      check(baked, curve_test::brute_distance(baked.samples, p), work, found);
      ran_out += found.certificate.exact ? 0 : 1;
    }
  }
  CHECK_LE(1000u, ran_out);
}

TEST(StarvedGuide_StaysTrue_AtEveryBudget) {
  starve(72, [](const Baked& baked, math::Vec3 p, double truth, uint32_t work,
                curve::Following& state) {
    const curve::Head& head = baked.view.head();
    const curve::Hold hold{0.1f * head.length_m, 0.3f * head.diagonal_m};
    const curve::Closest found = follow(baked.view, p, hold, Budget{work}, state).closest;
    query::Certificate certificate = found.certificate;
    CHECK_LE(double{certificate.lower_m}, truth * (1 + 1e-15));
    CHECK_GE(double{found.distance_m}, truth - kLost * std::max(double{head.diagonal_m}, truth));
    CHECK_LE(certificate.work, std::max(work, 2u));
  });
}

TEST(StarvedConstraint_StaysTrue_AtEveryBudget) {
  starve(73, [](const Baked& baked, math::Vec3 p, double truth, uint32_t work, curve::Following&) {
    curve::Neighbour memory[10];
    const curve::Closest found =
        nearest_constraint(baked.view, p, {}, {memory, 10}, Budget{work}).closest;
    CHECK_LE(double{found.certificate.lower_m}, truth * (1 + 1e-15));
    CHECK_LE(found.certificate.work, std::max(work, 1u));
  });
}
