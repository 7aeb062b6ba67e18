// Warm queries of a hand that moves little: what the last answer has certified lets a search stop
// early, and must never hide a nearer point. Against brute force in double, on the hard curves,
// with runs of every length.
#include <cstdio>
#include <cstdlib>

#include "curve/hard_curves.hpp"
#include "firmtouch/curve/closest_point.hpp"
#include "firmtouch/curve/guided_point.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch;
using curve_test::Baked;

const uint32_t kSteps =
    std::getenv("FIRMTOUCH_LONG") != nullptr ? 10000 : 250;  // a curve and length
constexpr double kPromise = 4e-7;                            // of max(diagonal, distance)

// Steps from nothing to a hundredth of the diagonal, about the curve, with a jump now and then.
struct Walker {
  std::mt19937 random;
  math::Vec3 at_m;

  double sign() { return curve_test::uniform(random) * 2 - 1; }
  void step(const Baked& baked) {
    const double diagonal = double{baked.view.head().diagonal_m};
    const double size = diagonal * std::pow(10.0, -2 - 4 * curve_test::uniform(random));
    if (curve_test::uniform(random) < 0.02) {
      const auto i = static_cast<size_t>(curve_test::uniform(random) *
                                         static_cast<double>(baked.samples.size()));
      at_m = baked.samples[i];
    }
    if (curve_test::uniform(random) < 0.1) return;  // stands still
    const double x = sign() * size, y = sign() * size, z = sign() * size;
    at_m = curve_test::point(double{at_m.x} + x, double{at_m.y} + y, double{at_m.z} + z);
  }
};

// The segments of a safe subtree and of its two neighbours of the same size, first to before end.
struct Stretch {
  uint32_t first, end;
};
Stretch stretch_of(const curve::View& view, uint32_t safe_subtree) {
  const uint32_t levels = view.run_levels();
  const uint32_t run = safe_subtree >> (levels + 1);
  const uint32_t node = safe_subtree & ((2u << levels) - 1);
  uint32_t level = 0;
  while (node + 1 >= (2u << level)) ++level;
  const uint32_t size = curve::run_segments_of(levels) >> level;
  const uint32_t run_first = run * curve::run_segments_of(levels);
  const uint32_t first = run_first + (node + 1 - (1u << level)) * size, after = first + 2 * size;
  const uint32_t run_end = run_first + curve::run_segments_of(levels);
  const uint32_t end = after < run_end ? after : run_end;
  return {first >= run_first + size ? first - size : first,
          end < view.segment_count() ? end : view.segment_count()};
}

}  // namespace

// Against every segment outside of it, in double: what the hint claims, not what a search makes of
// it.
TEST(SafeSubtree_LeavesNothingNearerOutside_AfterAnyQuery) {
  uint32_t checked = 0, tight = 0;
  for (uint32_t levels = 3; levels <= 8; ++levels) {
    for (const curve_test::NamedCurve& named : curve_test::hard_curves()) {
      const Baked baked(named.points, false, levels);
      test::note(named.name.c_str(), levels);
      Walker walker{std::mt19937(levels + 20), baked.samples[0]};
      curve::Hint hint;
      for (uint32_t i = 0; i < kSteps; ++i) {
        walker.step(baked);
        const math::Vec3 p = walker.at_m;
        hint.safe_subtree = query::kNowhere;  // so that this query leaves one of its own
        (void)closest_point(baked.view, p, query::kUnlimited, hint);
        if (hint.safe_subtree == query::kNowhere) continue;
        const Stretch kept = stretch_of(baked.view, hint.safe_subtree);
        double outside = HUGE_VAL;
        for (uint32_t s = 0; s < baked.view.segment_count(); ++s)
          if (s < kept.first || s >= kept.end)
            outside = std::min(
                outside,
                curve_test::nearest_on_segment(p, baked.samples[s], baked.samples[s + 1]).distance);
        ++checked;
        const double claimed = double{hint.safe_subtree_m};
        if (claimed > 0.5 * outside) ++tight;
        CHECK_LE(claimed, outside * (1 + 1e-6));
      }
    }
  }
  std::printf("      %u safe subtrees, %u within a half of the truth\n", checked, tight);
  CHECK_GE(checked, 500u);
  CHECK_GE(10 * tight, checked);  // or it would claim nothing
}

TEST(WarmQuery_FindsTheNearestPoint_AfterAnyCertificate) {
  uint32_t queries = 0, stopped_early = 0;
  for (uint32_t levels = 2; levels <= 8; ++levels) {
    for (const curve_test::NamedCurve& named : curve_test::hard_curves()) {
      const Baked baked(named.points, false, levels);
      CHECK(baked.report.problem.empty());
      test::note(named.name.c_str(), levels);
      Walker walker{std::mt19937(levels), baked.samples[0]};
      curve::Hint hint;
      for (uint32_t i = 0; i < kSteps; ++i) {
        walker.step(baked);
        const math::Vec3 p = walker.at_m;
        const double truth = curve_test::brute_distance(baked.samples, p);
        const double scale = std::max(double{baked.view.head().diagonal_m}, truth);
        const bool had_safe_subtree = hint.safe_subtree != query::kNowhere;
        const curve::Closest found = closest_point(baked.view, p, query::kUnlimited, hint);
        CHECK(found.certificate.exact);
        CHECK_LE(std::abs(double{found.distance_m} - truth), kPromise * scale);
        CHECK_LE(double{found.certificate.lower_m}, truth * (1 + 1e-15));
        CHECK_GE(double{found.certificate.lower_m}, truth - kPromise * scale);
        ++queries;
        curve::Hint without = hint;
        without.safe_subtree = query::kNowhere;
        without.position_m = p;
        if (had_safe_subtree &&
            found.certificate.steps <
                closest_point(baked.view, p, query::kUnlimited, without).certificate.steps)
          ++stopped_early;
        // A hint that a penalised query or a short budget left is as good.
        if (i % 16 == 5) (void)guided_point(baked.view, p, {0.1f, found.arc, true}, {40}, hint);
        if (i % 16 == 9) (void)closest_point(baked.view, p, {2}, hint);
      }
    }
  }
  std::printf("      %u of %u queries stopped early\n", stopped_early, queries);
  CHECK_GE(stopped_early, queries / 50);
}
