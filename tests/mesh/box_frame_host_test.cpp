// Askew parts, whose boxes are turned: distances, signs and bounds against brute force in double,
// crossings against every triangle, near the part and far from it; and the SIMD copy's bits.
#include <cmath>

#include "bake/mesh/box_frame.hpp"
#include "baked_mesh.hpp"
#include "brute_force.hpp"
#include "firmtouch/mesh/box_frame.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/mesh/segment_cast.hpp"
#include "firmtouch/mesh/segment_frame.hpp"
#include "harness/test.hpp"
#include "surface/make/make_cad.hpp"
#include "surface/make/make_part.hpp"
#include "true_distance.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT
using math::Vec3;

Vec3 random_point(const mesh::Head& head, Random& random, double reach) {
  const auto at = [&](size_t k) {
    const double low = double{head.low_m[k]}, high = double{head.high_m[k]};
    return static_cast<float>((low + high) / 2 +
                              random.between(-reach, reach) * double{head.diagonal_m});
  };
  return {at(0), at(1), at(2)};
}

double distance_to(const mesh::View& view, Vec3 p) {
  double least = 1e300;
  for (uint32_t t = 0; t < view.head().triangle_count; ++t) {
    const mesh::Triangle<uint32_t> of = view.triangle(t);
    least = std::min(
        least, true_distance(wide(p), wide(view.vertex(of.corner[0])),
                             wide(view.vertex(of.corner[1])), wide(view.vertex(of.corner[2]))));
  }
  return least;
}

uint32_t crossings_of_each(const mesh::View& view, Vec3 a_m, Vec3 b_m) {
  const mesh::SegmentFrame segment(view.head(), a_m, b_m);
  uint32_t crossings = 0;
  for (uint32_t t = 0; t < view.head().triangle_count; ++t) {
    const mesh::Triangle<uint32_t> of = view.triangle(t);
    if (segment
            .crossing(view.vertex(of.corner[0]), view.vertex(of.corner[1]),
                      view.vertex(of.corner[2]))
            .direction != 0)
      ++crossings;
  }
  return crossings;
}

}  // namespace

TEST(BoxFrame_AskewPart_IsTurned_AndOthersAreNot) {
  for (uint64_t seed = 0; seed < 4 * tools::kCadKinds; ++seed) {
    test::note("seed", static_cast<int64_t>(seed));
    const BakedMesh part(tools::to_surface(tools::make_cad(seed)));
    CHECK_EQ(part.view.box_frame() != nullptr, seed / tools::kCadKinds % 2 == 1);
  }
  CHECK(BakedMesh(tools::make_part(1, 5000)).view.box_frame() == nullptr);
  CHECK(BakedMesh(tools::to_surface(tools::make_cad(tools::kCadKinds)), tools::kBoundedTree)
            .view.box_frame() != nullptr);
}

TEST(BoxFrame_Distances_AgreeWithBruteForce) {
  const int points = long_run() ? 4000 : 250;
  for (uint64_t seed = tools::kCadKinds; seed < 2 * tools::kCadKinds; ++seed) {
    const BakedMesh part(tools::to_surface(tools::make_cad(seed)));
    const mesh::Head& head = part.view.head();
    Random random(seed);
    mesh::Hint warm;
    for (int i = 0; i < points; ++i) {
      test::note("case", i);
      const double reach = i % 3 == 0 ? 0.5 : i % 3 == 1 ? 0.9 : std::pow(10.0, i % 7);
      const Vec3 p = random_point(head, random, reach);
      const double truth = distance_to(part.view, p);
      const double within = 4e-7 * std::max(double{head.diagonal_m}, truth);
      mesh::Hint cold;
      for (mesh::Hint* hint : {&cold, &warm}) {
        const mesh::Closest answer = mesh::closest_point(part.view, p, query::kUnlimited, *hint);
        CHECK_LE(std::fabs(std::fabs(double{answer.distance_m}) - truth), within);
        CHECK_LE(double{answer.certificate.lower_m}, truth);
      }
      for (const uint32_t work : {1u, 20u, 100u}) {
        mesh::Hint hint;
        const mesh::Closest answer = mesh::closest_point(part.view, p, {work}, hint);
        CHECK_LE(double{answer.certificate.lower_m}, truth);
      }
    }
  }
}

// A segment that the tree misses would be one more or one less than triangle by triangle.
TEST(BoxFrame_Crossings_AreThoseOfEachTriangle) {
  uint32_t crossings = 0;
  for (uint64_t seed = tools::kCadKinds; seed < 2 * tools::kCadKinds; ++seed) {
    const BakedMesh part(tools::to_surface(tools::make_cad(seed)));
    Random random(seed);
    for (int i = 0; i < (long_run() ? 20000 : 2000); ++i) {
      test::note("case", i);
      const double reach = i % 2 == 0 ? 0.5 : std::pow(10.0, i % 5);
      const Vec3 a = random_point(part.view.head(), random, reach);
      // Half of them through a vertex, which is on the edge of a box.
      const Vec3 b = i % 4 < 2 ? random_point(part.view.head(), random, 0.3)
                               : part.view.vertex(random.below(part.view.head().vertex_count));
      const Vec3 beyond = b + (b - a);
      mesh::SurfaceCrossing found[64];
      const mesh::Crossings of =
          mesh::all_crossings(part.view, a, beyond, query::kUnlimited, found);
      CHECK_EQ(of.found, crossings_of_each(part.view, a, beyond));
      crossings += of.found;
    }
  }
  CHECK_GT(crossings, 1000u);
}
