// The oracle is right, and what it checks cannot pass by luck.
#include <cmath>
#include <vector>

#include "bench/certificates.hpp"
#include "bench/true_distance.hpp"
#include "harness/test.hpp"
#include "surface/make/make_part.hpp"
#include "surface/random.hpp"

namespace {

using namespace firmtouch;         // NOLINT: a test file
using namespace firmtouch::bench;  // NOLINT
using tools::Point;

math::Vec3 point_in(tools::Random& random, double reach) {
  return {static_cast<float>(random.between(-reach, reach)),
          static_cast<float>(random.between(-reach, reach)),
          static_cast<float>(random.between(-reach, reach))};
}

// Closes in on each distance with the budget, and needs 40 steps.
Reported honest(double truth, uint32_t budget) {
  const uint32_t steps = budget < 40 ? budget : 40;
  const double rest = 1 - static_cast<double>(steps) / 40;
  return {truth * (1 + rest), truth * (1 - rest), steps};
}

const std::vector<double>& truths() {
  static const std::vector<double> all = {1, 2, 3, 4, 5};
  return all;
}

}  // namespace

TEST(TrueDistanceIsThatOfEveryTriangle) {
  const tools::Surface part = tools::make_part(1, 2000);
  const TrueDistance truth(part);
  tools::Random random(4);
  for (int i = 0; i < 100; ++i) {
    test::note("query", i);
    const math::Vec3 p = point_in(random, i % 2 == 0 ? 0.06 : 5);
    double least = 1e300;
    for (const tools::Face& f : part.faces)
      least = std::fmin(least,
                        triangle_distance(tools::to_point(p), tools::to_point(part.vertices[f[0]]),
                                          tools::to_point(part.vertices[f[1]]),
                                          tools::to_point(part.vertices[f[2]])));
    CHECK_EQ(truth(p), least);
  }
}

TEST(ATrianglesDistanceIsKnownAtItsFaceSidesAndCorners) {
  const Point a{0, 0, 0}, b{4, 0, 0}, c{0, 3, 0};
  CHECK_EQ(triangle_distance({1, 1, 2}, a, b, c), 2.0);
  CHECK_EQ(triangle_distance({1, 1, 0}, a, b, c), 0.0);
  CHECK_EQ(triangle_distance({2, -3, 4}, a, b, c), 5.0);
  CHECK_EQ(triangle_distance({-3, -4, 0}, a, b, c), 5.0);
  CHECK_LE(std::fabs(triangle_distance({4, 3, 0}, a, b, c) - 2.4), 1e-15);
  CHECK_EQ(triangle_distance({5, 0, 0}, a, a, b), 1.0);
  CHECK_EQ(triangle_distance({0, 1, 0}, a, a, a), 1.0);
  const double sliver = triangle_distance({2, 0, 1e-3}, a, b, {2, 1e-9, 0});
  CHECK_LE(std::fabs(sliver - 1e-3), 1e-15);
}

TEST(AnHonestCertificateIsCountedClean) {
  const CertificateCounts counts = count_certificates(
      truths(), 10, [](size_t i, uint32_t budget) { return honest(truths()[i], budget); });
  CHECK_EQ(counts.worst_steps, 40u);
  CHECK_EQ(counts.queried, size_t{5 * 8});  // 1 2 4 8 16 32 40 and unlimited
  CHECK_EQ(counts.lower_wrong + counts.upper_wrong + counts.gap_grew, size_t{0});
  CHECK_LE(std::fabs(counts.half_gap_m - 3), 1e-12);
}

TEST(EachLieIsCounted) {
  const auto count = [](const std::function<void(Reported&, size_t, uint32_t)>& lie) {
    return count_certificates(truths(), 10, [&](size_t i, uint32_t budget) {
      Reported reported = honest(truths()[i], budget);
      lie(reported, i, budget);
      return reported;
    });
  };
  CHECK_EQ(count([](Reported& reported, size_t i, uint32_t budget) {
             if (i == 2 && budget == 4) reported.lower_m = 3.0000001;
           }).lower_wrong,
           size_t{1});
  CHECK_EQ(count([](Reported& reported, size_t i, uint32_t budget) {
             if (i == 1 && budget == 8) reported.upper_m = 2 - 5e-6;
           }).upper_wrong,
           size_t{1});
  CHECK_EQ(count([](Reported& reported, size_t i, uint32_t budget) {
             if (i == 3 && budget == 16) reported.upper_m = 9;
           }).gap_grew,
           size_t{1});
  CHECK_EQ(count([](Reported& reported, size_t, uint32_t) {
             reported.lower_m = std::nan("");
           }).lower_wrong,
           size_t{40});
  CHECK_EQ(count([](Reported& reported, size_t, uint32_t) {
             reported.upper_m = std::nan("");
           }).upper_wrong,
           size_t{40});
}

TEST(SharesOfTheTruthAreQuantiles) {
  const BoundShares shares = bound_shares(truths(), 20, [](size_t i, uint32_t budget) {
    Reported reported = honest(truths()[i], budget);
    if (i == 0) reported.lower_m = 0.1;
    return reported;
  });
  CHECK_LE(std::fabs(shares.lower_median - 0.5), 1e-12);
  CHECK_LE(std::fabs(shares.lower_p10 - 0.1), 1e-12);
  CHECK_LE(std::fabs(shares.upper_p90 - 1.5), 1e-12);
  CHECK_EQ(shares.exact, 0.0);
  CHECK_EQ(quantile({3, 1, 2}, 0.5), 2.0);
  CHECK_EQ(quantile({3, 1, 2}, 1), 3.0);
}
