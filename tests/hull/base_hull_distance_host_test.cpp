// Bounds of the mesh's distance from the base hull, checked against brute force in double.
#include <cfloat>

#include "../mesh/brute_force.hpp"
#include "bake/hull/bake_base_hull.hpp"
#include "bumpy_ring.hpp"
#include "firmtouch/hull/base_hull_cast.hpp"
#include "firmtouch/hull/base_hull_distance.hpp"
#include "firmtouch/hull/vertices.hpp"
#include "surface/make/make_part.hpp"

namespace firmtouch::tools {
namespace {

Surface surface_of(const hull::BaseHull& base_hull) {
  Surface surface;
  for (uint32_t i = 0; i < base_hull.face_count(); ++i) {
    for (uint32_t k = 0; k < 3; ++k)
      surface.vertices.push_back(hull::vertex(base_hull, base_hull.vertex_of(i, k)));
    surface.faces.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return surface;
}

mesh_test::Point wide(math::Vec3 v) { return {double{v.x}, double{v.y}, double{v.z}}; }

// Half the points near the surface, where base hull and mesh differ.
math::Vec3 some_point(const Surface& mesh, Random& random, int i) {
  const math::Vec3& v = mesh.vertices[random.below(static_cast<uint32_t>(mesh.vertices.size()))];
  const double reach = i % 2 == 0 ? 0.02 : 0.8;
  const auto near = [&](float at) {
    return at + static_cast<float>(reach * random.between(-1, 1));
  };
  const float x = near(v.x), y = near(v.y), z = near(v.z);
  return {x, y, z};
}

void check_distances(const BakedHull& baked, const hull::BaseHull& base_hull, int count) {
  const Surface of_base_hull = surface_of(base_hull);
  Random random(31);
  int outside = 0, inside = 0, between = 0;
  for (int i = 0; i < count; ++i) {
    test::note("point", i);
    const math::Vec3 p = some_point(baked.surface, random, i);
    const mesh_test::Truth to_mesh = mesh_test::brute_force(baked.surface, wide(p)),
                           to_base_hull = mesh_test::brute_force(of_base_hull, wide(p));
    for (const uint32_t steps : {UINT32_MAX, 40u, 12u, 3u, 1u}) {
      const hull::BaseHullDistance reported = hull::base_hull_distance(base_hull, p, {steps});
      CHECK_LE(reported.steps, steps);
      if (reported.side == hull::BaseHullSide::kOutside) {
        CHECK(!to_base_hull.inside);
        CHECK(!to_mesh.inside);
        CHECK_LE(double{reported.lower_m}, to_base_hull.distance);
        CHECK_LE(double{reported.lower_m}, to_mesh.distance);
        CHECK(!(reported.deepest_m < FLT_MAX));
      } else if (reported.side == hull::BaseHullSide::kInside) {
        CHECK(to_base_hull.inside);
        CHECK_EQ(reported.lower_m, 0.0f);
        CHECK_LE(to_base_hull.distance, double{reported.deepest_m});
        if (to_mesh.inside) CHECK_LE(to_mesh.distance, double{reported.deepest_m});
      } else {
        CHECK_EQ(reported.lower_m, 0.0f);
      }
      if (steps != UINT32_MAX) continue;
      CHECK(reported.exact);
      CHECK(reported.side != hull::BaseHullSide::kUnknown);
      if (reported.side == hull::BaseHullSide::kOutside)
        CHECK_LE(to_base_hull.distance - double{reported.lower_m}, 1e-5);
      CHECK_LE(std::fabs(length(wide(reported.point_m) - wide(p)) - to_base_hull.distance), 1e-5);
      outside += reported.side == hull::BaseHullSide::kOutside ? 1 : 0;
      inside += to_mesh.inside ? 1 : 0;
      between += to_base_hull.inside && !to_mesh.inside ? 1 : 0;
    }
  }
  CHECK_LT(count / 10, outside);
  CHECK_LT(count / 50, inside);
  CHECK_LT(0, between);
}

}  // namespace

TEST(WhatABaseHullCertifiesOfTheMeshIsTrueUnderEveryBudget) {
  const BakedHull ring(bumpy_ring(8, 4, 0.2), 150, 16);
  check_distances(ring, ring.view.base_hull(), 600);
  const std::vector<uint32_t> words = cut_base_hull(ring.view, 400);
  hull::BaseHull finer;
  CHECK_EQ(hull::open_base_hull({reinterpret_cast<const uint8_t*>(words.data()),
                                 static_cast<uint32_t>(4 * words.size())},
                                ring.view, finer)
               .rule,
           0);
  check_distances(ring, finer, 300);
}

// From one to a million diagonals away, and about a hull that is itself far from the origin.
TEST(BaseHull_FarPoints_LowerBoundIsBelowTheTruthByItsRounding) {
  for (const float away : {0.0f, 2000.0f}) {
    const Point shift{double{away}, -double{away}, 0};
    const BakedHull ring(mesh_test::moved(bumpy_ring(4, 2, 0.2), 1, shift), 100, 16);
    const hull::BaseHull& base_hull = ring.view.base_hull();
    const Surface surface = surface_of(base_hull);
    const mesh_test::BruteForce by_force(surface);
    Random random(3);
    for (int i = 0; i < 3000; ++i) {
      test::note("point", i);
      const double reach = std::pow(10.0, i % 7);
      const auto off = [&] { return reach * random.between(-1, 1); };
      const math::Vec3 p = mesh_test::narrow(Point{3 + off(), 3 + off(), off()} + shift);
      const double truth = by_force(wide(p)).distance;
      const hull::BaseHullDistance reported =
          hull::base_hull_distance(base_hull, p, query::kUnlimited);
      CHECK(reported.exact);
      if (reported.side != hull::BaseHullSide::kOutside) continue;
      CHECK_LE(double{reported.lower_m}, truth);
      CHECK_LE(truth - double{reported.lower_m}, 1e-5 + 6e-7 * truth);
    }
  }
}

TEST(BaseHull_HostilePoints_GiveFiniteDistances) {
  const BakedHull ring(bumpy_ring(4, 2), 100, 22);
  const float values[] = {0,       -0.0f,  1e-42f, 1,       1e7f, 3e18f,
                          1.9e19f, -3e19f, 3e38f,  FLT_MAX, NAN,  INFINITY};
  for (const float x : values)
    for (const float y : values)
      for (const float z : values) {
        const hull::BaseHullDistance reported =
            hull::base_hull_distance(ring.view.base_hull(), {x, y, z}, query::kUnlimited);
        CHECK(reported.lower_m >= 0 && reported.lower_m <= FLT_MAX);
        CHECK(reported.deepest_m >= 0 && reported.deepest_m <= FLT_MAX);
        CHECK_LE(length(wide(reported.point_m)), 10.0);
        const bool finite = std::isfinite(x) && std::isfinite(y) && std::isfinite(z);
        const double off = length({double{x}, double{y}, double{z}});
        if (finite && off > 10) CHECK(reported.side == hull::BaseHullSide::kOutside);
        if (finite && off > 10) CHECK_LE(double{reported.lower_m}, off + 10);
        if (finite && off > 1e19) CHECK_LE(0.99e19, double{reported.lower_m});
        if (!finite) CHECK_EQ(reported.lower_m, 0.0f);
        if (!finite) CHECK_EQ(reported.steps, 0u);
      }
}

// The line that decides the side passes a corner, which only integers decide.
TEST(BaseHull_LineThroughACorner_IsChargedAndKnownOrUnknown) {
  const BakedHull ring(bumpy_ring(8, 4, 0.2), 150, 16);
  const hull::BaseHull& base_hull = ring.view.base_hull();
  const Surface surface = surface_of(base_hull);
  int charged = 0, starved = 0;
  for (const math::Vec3& corner : surface.vertices)
    for (const float off : {-0.11f, 0.07f}) {
      const math::Vec3 p{corner.x + off, corner.y, corner.z};
      const bool is_inside = mesh_test::brute_force(surface, wide(p)).inside;
      for (const uint32_t work : {UINT32_MAX, 640u, 160u, 40u, 1u}) {
        const hull::BaseHullDistance reported = hull::base_hull_distance(base_hull, p, {work});
        CHECK_LE(reported.work, work);
        if (reported.side == hull::BaseHullSide::kUnknown)
          ++starved;
        else
          CHECK_EQ(reported.side == hull::BaseHullSide::kInside, is_inside);
        if (work != UINT32_MAX) continue;
        CHECK(reported.side != hull::BaseHullSide::kUnknown);
        charged += reported.work >= reported.steps + 100 ? 1 : 0;
      }
      // What integers decide is not begun without a budget: one such face and the rest of its leaf
      // take less than 130 units.
      int32_t winding = 0;
      query::Work whole(query::kUnlimited);
      CHECK(hull::wind_around(base_hull, p, whole, winding));
      if (whole.used() <= 130) continue;
      query::Work short_of_it(query::Budget{whole.used() - 130});
      CHECK(!hull::wind_around(base_hull, p, short_of_it, winding));
      CHECK_EQ(winding, 0);
    }
  CHECK_LT(100, charged);
  CHECK_LT(100, starved);
}

}  // namespace firmtouch::tools
