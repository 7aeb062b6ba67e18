// What the grid bench compares agrees: sides by pseudonormals, by rays and by the firmware.
#include "lab/grid.hpp"

#include <cmath>
#include <vector>

#include "firmtouch/mesh/closest_point.hpp"
#include "harness/test.hpp"
#include "lab/orders/orders.hpp"
#include "lab/trials.hpp"

using namespace firmtouch;       // NOLINT: a test file
using namespace firmtouch::lab;  // NOLINT

TEST(VoxelsFillTheCubeAboutTheModel) {
  const Model part = demo_part(Sides::kSigned, 2000);
  const std::vector<math::Vec3> points = voxels(part, 10);
  CHECK_EQ(points.size(), size_t{1000});
  const mesh::Head& head = part.view.head();
  float side = 0;
  for (int k = 0; k < 3; ++k) side = std::fmax(side, head.high_m[k] - head.low_m[k]);
  const float first[3] = {points[0].x, points[0].y, points[0].z};
  const float last[3] = {points[999].x, points[999].y, points[999].z};
  for (int k = 0; k < 3; ++k) {
    CHECK_LE(std::fabs(last[k] - first[k] - 0.9f * side), 1e-6f);
    CHECK_LE(std::fabs(last[k] + first[k] - head.low_m[k] - head.high_m[k]), 1e-6f);
  }
}

TEST(RaysPseudonormalsAndFirmware_GiveTheSameSigns) {
  const Model part = demo_part(Sides::kSigned, 2000);
  const Grown<orders::FloatKind> aligned(part.view);
  const Grown<orders::OrientedKind> oriented(part.view);
  std::vector<orders::Pending> waiting(orders::kQueueBoxes + orders::kStackBoxes);
  size_t inside_count = 0;
  for (const math::Vec3& p_m : voxels(part, 12)) {
    mesh::Hint hint;
    const bool inside =
        mesh::closest_point(part.view, p_m, query::kUnlimited, hint).certificate.sign < 0;
    inside_count += inside;
    CHECK_EQ((orders::crossings(aligned.tree(), {p_m, kRayAlong}) & 1u) != 0, inside);
    CHECK_EQ((orders::crossings(oriented.tree(), {p_m, kRayAlong}) & 1u) != 0, inside);
    orders::Nearest nearest;
    orders::Counters ignored;
    CHECK((orders::find_nearest<orders::OrientedKind, orders::Order::kBestFirst,
                                orders::Upper::kVertex, false>(
        oriented.tree(), p_m, {waiting.data(), static_cast<uint32_t>(waiting.size())}, ignored,
        nearest)));
    CHECK_EQ(orders::is_inside(part.view, nearest), inside);
  }
  CHECK(inside_count > 50 && inside_count < 1000);
}

TEST(ARayBesideABoxMissesItAndOneThroughItHits) {
  const orders::FloatBox box{{1, 1, 1}, {2, 2, 2}};
  CHECK(orders::may_cross(box, {{0, 0, 0}, {1, 1.1f, 0.9f}}));
  CHECK(!orders::may_cross(box, {{0, 0, 0}, {-1, -1.1f, -0.9f}}));  // it lies behind
  CHECK(!orders::may_cross(box, {{0, 0, 0}, {1, 3, 1}}));
  CHECK(orders::may_cross(box, {{1.5f, 1.5f, 1.5f}, {1, 3, 1}}));  // from inside
  orders::OrientedBox turned;
  turned.centre_m = {5, 0, 0};
  turned.axis[0] = {0.6f, 0.8f, 0};
  turned.axis[1] = {-0.8f, 0.6f, 0};
  turned.axis[2] = {0, 0, 1};
  turned.half_m = {2, 0.1f, 1};
  CHECK(orders::may_cross(turned, {{5, -5, 0.1f}, {1e-3f, 1, 1e-3f}}));
  CHECK(!orders::may_cross(turned, {{7, -5, 0.1f}, {1e-3f, 1, 1e-3f}}));
}
