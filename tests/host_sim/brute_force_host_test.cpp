// The simulator's oracle of distances against the plain minimum over all triangles.
#include "host_sim/plant/brute_force.hpp"

#include <algorithm>
#include <cmath>

#include "bench/models.hpp"
#include "harness/test.hpp"
#include "surface/triangle_distance.hpp"

using namespace firmtouch;  // NOLINT: a test file

TEST(BruteForce_PassesOverNoTriangleThatIsNearest) {
  const bench::Model part = bench::demo_part(bench::Sides::kUnsigned, 3000);
  const mesh::View& mesh = part.view;
  const host_sim::BruteForce oracle(mesh);
  const auto corner = [&](uint32_t i) {
    return tools::to_point(
        {mesh.vertices()[i].x_m, mesh.vertices()[i].y_m, mesh.vertices()[i].z_m});
  };
  size_t nearest = 0, none = 0;
  for (uint32_t near = 0; near < mesh.head().triangle_count; ++near) {  // each once the nearest
    const mesh::Triangle<uint32_t> at = mesh.triangle(near);
    const host_sim::Vec middle_m =
        (corner(at.corner[0]) + corner(at.corner[1]) + corner(at.corner[2])) * (1.0 / 3);
    const host_sim::Vec at_m = middle_m + host_sim::Vec{1e-5, 2e-5, -1e-5};
    double least_m2 = HUGE_VAL;
    for (uint32_t i = 0; i < mesh.head().triangle_count; ++i) {
      const mesh::Triangle<uint32_t> t = mesh.triangle(i);
      least_m2 = std::min(
          least_m2, tools::distance2_to_triangle(at_m, corner(t.corner[0]), corner(t.corner[1]),
                                                 corner(t.corner[2])));
    }
    CHECK_EQ(oracle.distance_m(at_m, nearest), std::sqrt(least_m2));  // from the one before
    size_t far = (near + 1234567u) % mesh.head().triangle_count, beyond = SIZE_MAX;
    CHECK_EQ(oracle.distance_m(at_m, far), std::sqrt(least_m2));
    CHECK_EQ(oracle.distance_m(at_m, beyond), std::sqrt(least_m2));
  }
  CHECK(std::isinf(host_sim::BruteForce().distance_m({}, none)));
}
