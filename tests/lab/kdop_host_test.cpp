// The k-DOP baseline: all its trees find what brute force in double finds.
#include "bench/segments.hpp"
#include "harness/test.hpp"
#include "lab/kdop_tree.hpp"
#include "lab/trials.hpp"

namespace firmtouch::lab {

TEST(EveryKdopTreeFindsTheCrossingsOfBruteForce) {
  const Model part = demo_part(Sides::kSigned, 2000);
  for (const uint32_t k : {6u, 14u, 18u, 26u}) {
    const KdopTree tree(part.surface, k);
    uint64_t of_intervals = 0, of_clipping = 0, crossings = 0;
    for (const FloatSegment& s : across_box(part, 300, 3)) {
      uint32_t wanted = 0;
      double t;
      for (uint32_t f = 0; f < part.surface.faces.size(); ++f)
        wanted +=
            crosses(part.surface, f, tools::to_point(s.a_m), tools::to_point(s.b_m), t) ? 1u : 0u;
      for (const KdopTree::Test test : {KdopTree::Test::kIntervals, KdopTree::Test::kClip}) {
        uint64_t& visits = test == KdopTree::Test::kClip ? of_clipping : of_intervals;
        CHECK_EQ(tree.crossings(tools::to_point(s.a_m), tools::to_point(s.b_m), test, visits),
                 wanted);
      }
      crossings += wanted;
      std::vector<double> all;
      if (all_crossings_in_double(part.surface, s, all)) CHECK_EQ(all.size(), wanted);
    }
    CHECK_LT(50u, crossings);
    CHECK_LT(2 * of_clipping, of_intervals);
  }
}

}  // namespace firmtouch::lab
