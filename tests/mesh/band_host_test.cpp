// Band queries: exact within the band, beyond it a certified lower bound in bounded work.
#include <cmath>

#include "baked_mesh.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "harness/test.hpp"
#include "surface/make/make_cad.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT
using math::Vec3;

void check_band(const mesh::Closest& c, const Truth& truth, double size, double band_m) {
  const double reported = std::fabs(double{c.distance_m}), scale = std::max(size, truth.distance);
  CHECK_LE(truth.distance - reported, 4e-7 * scale);
  CHECK_LE(double{c.certificate.lower_m}, truth.distance + 1e-9 * scale);
  if (truth.distance > 2e-6 * size && c.certificate.sign != 0)
    CHECK_EQ(c.certificate.sign, truth.inside ? -1 : 1);
  if (truth.distance < band_m - 4e-7 * scale) {
    CHECK(c.certificate.exact);
    CHECK_LE(reported - truth.distance, 4e-7 * scale);
  } else if (truth.distance > band_m + 4e-7 * scale) {
    CHECK(!c.certificate.exact);
    CHECK_LE(band_m - 4e-7 * scale, double{c.certificate.lower_m});
  }
}

TEST(WithinTheBandExactBeyondItCertified) {
  const double size = diagonal(part().surface);
  uint32_t inside_band = 0;
  const std::vector<Vec3> queries = hard_queries(part().surface, 600, 3);
  for (const double share : {0.0, 0.002, 0.02, 0.3}) {
    mesh::Hint warm;
    for (const Vec3 p : queries) {
      const Truth truth = brute_force(part().surface, wide(p));
      query::Budget budget;
      budget.band_m = static_cast<float>(share * size);
      mesh::Hint cold;
      check_band(mesh::closest_point(part().view, p, budget, cold), truth, size, share * size);
      check_band(mesh::closest_point(part().view, p, budget, warm), truth, size, share * size);
      inside_band += truth.distance < share * size ? 1u : 0u;
    }
  }
  CHECK_LT(100u, inside_band);
}

TEST(FarAwayABandCostsLittle) {
  const double size = diagonal(part().surface);
  query::Budget budget;
  budget.band_m = static_cast<float>(0.01 * size);
  for (const Vec3 p : hard_queries(part().surface, 200, 4)) {
    if (brute_force(part().surface, wide(p)).distance < 0.2 * size) continue;
    mesh::Hint hint;
    CHECK_LE(mesh::closest_point(part().view, p, budget, hint).certificate.steps, 40u);
  }
}

// Machined parts, whose long edges make float32 alone too coarse for an exact answer.
TEST(WithAThresholdTheSideIsDecidedAsByAnExactAnswer) {
  uint32_t above = 0, below = 0, coarse = 0;
  for (uint64_t seed = 0; seed < tools::kCadKinds; ++seed) {
    const BakedMesh baked(tools::to_surface(tools::make_cad(seed)));
    mesh::Hint warm, exact_warm;
    for (const Vec3 p : hard_queries(baked.surface, 150, seed)) {
      const double truth_m = brute_force(baked.surface, wide(p)).distance;
      for (const double share : {0.9, 0.999999, 1.000001, 1.1}) {
        query::Budget budget;
        budget.threshold_m = static_cast<float>(truth_m * share);
        const mesh::Closest c = mesh::closest_point(baked.view, p, budget, warm);
        const mesh::Closest exact =
            mesh::closest_point(baked.view, p, query::kUnlimited, exact_warm);
        coarse += exact.certificate.exact && !c.certificate.exact;
        const double scale = std::max(double{baked.size}, truth_m),
                     d = std::fabs(double{c.distance_m});
        CHECK_LE(double{c.certificate.lower_m}, truth_m + 1e-9 * scale);
        CHECK_LE(truth_m - d, 4e-7 * scale);
        if (exact.certificate.lower_m >= budget.threshold_m) {
          CHECK_GE(c.certificate.lower_m, budget.threshold_m);
          ++above;
        }
        if (std::fabs(exact.distance_m) < budget.threshold_m - 4e-7f * static_cast<float>(scale)) {
          CHECK_LT(d, double{budget.threshold_m});
          ++below;
        }
      }
    }
  }
  CHECK_LE(500u, above);
  CHECK_LE(500u, below);
  CHECK_LE(500u, coarse);
}

TEST(NanBand_IsABandOfZero) {
  const Vec3 p{0.01f, 0.02f, 0.03f};
  for (const float band_m : {std::nanf(""), -1.0f, 0.0f}) {
    query::Budget budget;
    budget.band_m = band_m;
    mesh::Hint hint;
    const mesh::Closest c = mesh::closest_point(part().view, p, budget, hint);
    CHECK(std::isfinite(c.distance_m));
    CHECK_LE(c.certificate.lower_m, std::fabs(c.distance_m));
  }
  query::Budget unbounded;
  unbounded.band_m = INFINITY;
  mesh::Hint hint, other;
  const mesh::Closest c = mesh::closest_point(part().view, p, unbounded, hint);
  CHECK(c.certificate.exact);
  const mesh::Closest d = mesh::closest_point(part().view, p, query::kUnlimited, other);
  CHECK_EQ(c.certificate.steps, d.certificate.steps);
}

}  // namespace
