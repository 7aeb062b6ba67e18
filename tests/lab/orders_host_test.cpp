// Every query order, upper bound and kind of box gives the nearest triangle, and says what it took.
#include <cmath>
#include <string>
#include <vector>

#include "bench/models.hpp"
#include "bench/true_distance.hpp"
#include "harness/test.hpp"
#include "lab/orders/build.hpp"
#include "lab/orders/contest.hpp"
#include "lab/trials.hpp"
#include "surface/random.hpp"

namespace {

using namespace firmtouch;       // NOLINT: a test file
using namespace firmtouch::lab;  // NOLINT
using orders::Contest;
using orders::Counters;
using orders::Entrant;

const Model& part() {
  static const Model model = demo_part(Sides::kUnsigned, 2000);
  return model;
}

// By every triangle, in double.
double by_force(const tools::Surface& surface, math::Vec3 p_m) {
  double least = 1e300;
  for (const tools::Face& f : surface.faces)
    least = std::fmin(
        least, triangle_distance(tools::to_point(p_m), tools::to_point(surface.vertices[f[0]]),
                                 tools::to_point(surface.vertices[f[1]]),
                                 tools::to_point(surface.vertices[f[2]])));
  return least;
}

void check_all(const Model& model, const std::vector<math::Vec3>& points) {
  const Contest contest(model.view);
  CHECK_EQ(contest.entrants().size(), size_t{48});
  for (const math::Vec3& p_m : points) {
    const double truth_m = by_force(model.surface, p_m);
    for (size_t i = 0; i < contest.entrants().size(); ++i) {
      test::note("entrant", static_cast<int64_t>(i));
      const double reported_m = std::sqrt(double{contest.entrants()[i].nearest(p_m).distance2_m2});
      CHECK_LE(std::fabs(reported_m - truth_m), 4e-7 * std::fmax(model.diagonal_m(), truth_m));
    }
  }
}

// A fan of needles about one corner, and a few flat patches: boxes without volume.
tools::Surface needles() {
  tools::Surface surface;
  surface.vertices.push_back({0, 0, 0});
  tools::Random random(3);
  for (uint32_t i = 0; i < 60; ++i) {
    const float x = static_cast<float>(random.between(-1, 1));
    const float y = static_cast<float>(random.between(-1, 1));
    const float z = i % 3 == 0 ? 0.0f : static_cast<float>(random.between(-1, 1));
    surface.vertices.push_back({x, y, z});
    surface.vertices.push_back({x + 1e-3f, y, z});
    surface.faces.push_back({0, 2 * i + 1, 2 * i + 2});
    surface.source.push_back(i);
  }
  return surface;
}

}  // namespace

TEST(EveryCombinationFindsTheNearestOfThePart) {
  std::vector<math::Vec3> points = random_points(part(), 60);
  const std::vector<math::Vec3> path = walk(part(), 60);
  points.insert(points.end(), path.begin(), path.end());
  for (const math::Vec3& v : {part().surface.vertices[0], part().surface.vertices[77]})
    points.push_back(v);
  points.push_back({0, 0, 0});
  check_all(part(), points);
}

TEST(EveryCombinationFindsTheNearestOfNeedlesAndFlats) {
  const Model model = model_of(needles(), "needles", "", Sides::kUnsigned);
  check_all(model, random_points(model, 150));
}

TEST(AnOrientedBoxHoldsItsTrianglesAndFitsThemClosely) {
  // A plate, turned: its box must be as thin as it is.
  tools::Surface plate;
  for (int i = 0; i <= 20; ++i)
    for (int k = 0; k < 2; ++k) {
      const float along = static_cast<float>(i) * 0.05f, across = static_cast<float>(k) * 0.2f;
      plate.vertices.push_back({0.6f * along - 0.8f * across, 0.8f * along + 0.6f * across, along});
    }
  for (uint32_t i = 0; i < 40; ++i) {
    plate.faces.push_back({i, i + 1, i + 2});
    plate.source.push_back(i);
  }
  const Model model = model_of(plate, "plate", "", Sides::kUnsigned);
  const orders::OrientedBox box =
      orders::fit_oriented(model.view, 0, model.view.head().triangle_count);
  const float thinnest = std::fmin(box.half_m.x, std::fmin(box.half_m.y, box.half_m.z));
  CHECK_LE(thinnest, 1e-5f);
  orders::OrientedQuery query;
  for (const math::Vec3& v : plate.vertices) {
    CHECK(query.begin(model.view.head(), v));
    CHECK_EQ(query.key(box), 0u);
  }
}

TEST(CountersSayWhatWasRead) {
  const Contest contest(part().view);
  const std::vector<math::Vec3> points = random_points(part(), 50);
  uint32_t min_steps[3] = {UINT32_MAX, UINT32_MAX, UINT32_MAX};
  for (const Entrant& e : contest.entrants()) {
    const Counters c = e.count(points);
    CHECK_GE(c.nodes, 50u * 3);
    CHECK_GE(c.triangles, 50u);
    CHECK_GE(c.boxes, c.nodes / 2);
    CHECK(c.max_pending > 0);
    const size_t order = e.order == "depth-first" ? 0 : e.order == "best-first" ? 1 : 2;
    if (e.kind == "16-bit AABB") min_steps[order] = std::min(min_steps[order], c.nodes);
  }
  // Best-first reads no box that could be left out; breadth-first finds its triangles last.
  CHECK_LE(min_steps[1], min_steps[0]);
  CHECK_LE(min_steps[0], min_steps[2]);
}

TEST(AFullQueueLosesNothing) {
  // The middle of a sphere: every triangle is as near as any other.
  tools::Surface ball;
  const int rings = 40, around = 60;
  for (int i = 0; i <= rings; ++i)
    for (int k = 0; k < around; ++k) {
      const double polar = 3.141592653589793 * i / rings, turn = 6.283185307179586 * k / around;
      ball.vertices.push_back({static_cast<float>(std::sin(polar) * std::cos(turn)),
                               static_cast<float>(std::sin(polar) * std::sin(turn)),
                               static_cast<float>(std::cos(polar))});
    }
  for (uint32_t i = 1; i + 2 < rings; ++i)
    for (uint32_t k = 0; k < around; ++k) {
      const uint32_t a = i * around + k, b = i * around + (k + 1) % around;
      ball.faces.push_back({a, b, a + around});
      ball.faces.push_back({b, b + around, a + around});
    }
  for (uint32_t f = 0; f < ball.faces.size(); ++f) ball.source.push_back(f);
  const Model model = model_of(ball, "ball", "", Sides::kUnsigned);
  const Contest contest(model.view);
  const double truth_m = by_force(ball, {0, 0, 0});
  bool was_full = false;
  for (const Entrant& e : contest.entrants()) {
    was_full = was_full || e.count({{0, 0, 0}}).overflows > 0;
    CHECK_LE(std::fabs(std::sqrt(double{e.nearest({0, 0, 0}).distance2_m2}) - truth_m), 1e-6);
  }
  CHECK(was_full);
}
