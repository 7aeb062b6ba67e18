// The baker of curves: what it stores is proven, the same on every run, and small.
#include "bake/curve/bake_curve.hpp"

#include <chrono>
#include <cstdio>

#include "curve/hard_curves.hpp"
#include "firmtouch/curve/closest_point.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;
using curve_test::Baked;

}  // namespace

TEST(EveryHardCurveIsBakedAndProven) {
  for (const curve_test::NamedCurve& named : curve_test::hard_curves()) {
    const Baked baked(named.points);
    test::note(named.name.c_str(), 0);
    CHECK(baked.report.problem.empty());
    CHECK(baked.view.is_open());
    CHECK_EQ(baked.report.is_closed, named.name == "closed");
    const uint32_t levels = baked.view.run_levels();
    const uint64_t segments = 4u << levels, parts = 2u << levels;
    const uint64_t runs = (baked.report.samples - 1 + segments - 1) / segments;
    CHECK_EQ(baked.report.tick_bytes,
             68 + 16ull * baked.report.samples + (32 + 2 * parts) * runs - 12);
  }
}

TEST(TheSamePointsGiveTheSameBytes) {
  const Baked first(curve_test::knot(3000, 6, 8)), second(curve_test::knot(3000, 6, 8));
  CHECK_EQ(first.sections.size(), second.sections.size());
  for (size_t i = 0; i < first.sections.size(); ++i) {
    CHECK_EQ(first.sections[i].type, second.sections[i].type);
    CHECK(first.sections[i].bytes == second.sections[i].bytes);
  }
}

TEST(EveryCountFromTwoToSixtyFillsTheTreeFromTheLeft) {
  for (uint32_t count = 2; count <= 60; ++count) {
    const Baked baked(curve_test::spread(count, 1.0, 0, count));
    test::note("samples", count);
    CHECK(baked.report.problem.empty());
  }
}

TEST(TickReads_AtMostTwentyBytesASample_OfFineCurve) {
  for (const uint32_t count : {2000u, 20000u}) {
    const Baked baked(curve_test::knot(count, 1, 3));
    CHECK_LE(baked.report.tick_bytes, 20ull * count);
  }
}

TEST(DroppedRows_AreListedForTools) {
  tools::CurvePoints points;
  points.samples_m = {{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  tools::CurveReport report;
  const auto sections = tools::bake_curve(points, "path", report);
  CHECK_EQ(sections.size(), 7u);
  CHECK_EQ(sections.back().type, curve::kRowsSection);
  const std::vector<uint32_t> rows{0, 1, 3};
  CHECK(sections.back().bytes == tools::make_section(0, "", rows).bytes);
}

TEST(APointOfNoCurveIsRefused) {
  tools::CurvePoints points;
  tools::CurveReport report;
  points.samples_m = {{1, 2, 3}};
  CHECK(tools::bake_curve(points, "path", report).empty());
  CHECK(report.problem.find("path: only one sample") != std::string::npos);
}

TEST(TwoHundredThousandSamplesBakeInHalfASecondAndStayExact) {
  const auto start = std::chrono::steady_clock::now();
  const Baked baked(curve_test::knot(200000, 2, 12));
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("      200,000 samples baked and opened in %.2f s\n", seconds);
  CHECK(baked.report.problem.empty());
  CHECK_LE(seconds, 5.0);
  curve::Hint warm;
  for (const math::Vec3& p : curve_test::queries(baked.samples, 40, 13)) {
    const double truth = curve_test::brute_distance(baked.samples, p);
    const curve::Closest found = closest_point(baked.view, p, query::kUnlimited, warm);
    const double scale = std::max(double{baked.view.head().diagonal_m}, truth);
    CHECK_LE(std::abs(double{found.distance_m} - truth), 4e-7 * scale);
    CHECK_LE(double{found.certificate.lower_m}, truth);
  }
}
