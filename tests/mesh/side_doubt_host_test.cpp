// What float32 loses of an offset may turn its height above a pseudonormal's plane: no sign then.
#include "bake/mesh/bake_mesh.hpp"
#include "firmtouch/mesh/direction.hpp"
#include "firmtouch/mesh/nearest_answer.hpp"
#include "harness/test.hpp"
#include "surface/random.hpp"
#include "true_distance.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using math::Vec3;
using tools::Point;

// Decides as the firmware does, and keeps the doubt.
struct Signs {
  mutable float doubt_m = 0;
  int sign(float height_m, float of_m) const {
    doubt_m = of_m;
    return height_m > of_m ? 1 : height_m < -of_m ? -1 : 0;
  }
};

// The largest error of a plain offset from an edge, across it, in hill climbing over queries beside
// the edge of one triangle of unit length.
double worst_offset_error(tools::Random& random) {
  const auto anywhere = [&](double reach) {
    return Point{random.between(-reach, reach), random.between(-reach, reach),
                 random.between(-reach, reach)};
  };
  double worst = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a = tools::to_vec3(anywhere(1)), b = tools::to_vec3(anywhere(1));
    const Point edge = tools::to_point(b) - tools::to_point(a);
    const Point out = cross(edge, anywhere(1)), third = out * (-0.5 / length(out));
    const Vec3 c = tools::to_vec3(tools::to_point(a) + edge * 0.5 + third);
    const Vec3 p = tools::to_vec3(tools::to_point(a) + edge * random.between(0, 1) +
                                  out * (1e-4 / length(out)));
    const mesh::Foot foot = mesh::closest_on_triangle(p, a, b, c);
    if (foot.feature != mesh::Feature::kEdge0) continue;
    const Point from_a = tools::to_point(p) - tools::to_point(a);
    const Point offset = from_a - edge * (dot(from_a, edge) / dot(edge, edge));
    const Point error = tools::to_point(foot.offset_m) - offset;
    const Point across = error - edge * (dot(error, edge) / dot(edge, edge));
    worst = std::max(worst, length(across) / length(edge));
  }
  return worst;
}

}  // namespace

TEST(SideDoubt_CoversTheLossOfTheOffset) {
  tools::Random random(41);
  const double error = worst_offset_error(random);
  CHECK_GT(error, 0x1p-24);  // else this shows nothing
  mesh::Head head{};
  head.longest_edge_m = 1;
  head.diagonal_m = 1;
  const mesh::Loss loss(head);
  const float distance_m = 1e-5f;  // either sign is right nearer than 2e-6
  const float loss_m = loss.reported_m(distance_m);
  // A plane above which the true height may have the other sign.
  const Signs signs;
  const float height = static_cast<float>(0.9 * error) / distance_m;
  for (const float side : {height, -height})
    CHECK_EQ(int{mesh::sign_of(signs, {distance_m, 0, 0}, distance_m, {side, 0, 0}, loss_m, 1)}, 0);
  CHECK_GE(double{signs.doubt_m}, error);
}
