// A sphere on its way: the free part is free, by brute force in double, and not needlessly short.
#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

#include "baked_mesh.hpp"
#include "firmtouch/mesh/swept_sphere.hpp"
#include "harness/test.hpp"
#include "surface/make/make_cad.hpp"
#include "surface/make/make_part.hpp"

namespace {

using namespace firmtouch;  // NOLINT: a test file
using namespace mesh_test;  // NOLINT
using math::Vec3;

Point random_vector(Random& random) {
  return {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)};
}

// Least distance of a way to the stored triangles. Along a line the distance of a triangle is
// convex.
double clearance(const mesh::View& view, Point from, Point along) {
  const double half = length(along) / 2;
  double least = 1e300;
  for (uint32_t i = 0; i < view.head().triangle_count; ++i) {
    const auto t = view.triangle(i);
    const Point a = wide(view.vertex(t.corner[0])), b = wide(view.vertex(t.corner[1])),
                c = wide(view.vertex(t.corner[2]));
    const auto at = [&](double s) {
      const Point p = from + along * s;
      return length(tools::closest_of(p, a, b, c) - p);
    };
    if (at(0.5) - half >= least) continue;
    double low = 0, high = 1;
    for (int k = 0; k < 70; ++k) {
      const double one = low + (high - low) * 0.45, two = low + (high - low) * 0.55;
      if (at(one) < at(two))
        high = two;
      else
        low = one;
    }
    least = std::min({least, at(low), at(0), at(1)});
  }
  return least;
}

struct Seen {
  uint32_t whole = 0, partly = 0, none = 0;
};

// Spheres about as far from the surface as they are large, up to the radius or in it.
Seen check_ways(const BakedMesh& baked, uint64_t seed, uint32_t ways) {
  Random random(seed);
  Seen seen;
  const double size = baked.size;
  for (uint32_t i = 0; i < ways; ++i) {
    const auto& face =
        baked.surface.faces[random.below(static_cast<uint32_t>(baked.surface.faces.size()))];
    const double u = random.between(0, 1), v = random.between(0, 1 - u);
    const Point a = wide(baked.surface.vertices[face[0]]),
                b = wide(baked.surface.vertices[face[1]]),
                c = wide(baked.surface.vertices[face[2]]);
    const Point normal = cross(b - a, c - a);
    const Point unit = normal * (1 / length(normal));
    query::SweptSphere sphere;
    sphere.radius_m = static_cast<float>(size * std::pow(10, random.between(-6, -1.5)));
    const double off = double{sphere.radius_m} * random.between(0.9, 1.4);
    sphere.from_m = narrow(a + (b - a) * u + (c - a) * v + unit * off);
    Point along = random_vector(random) * (size * std::pow(10, random.between(-5, -1)));
    if (random.below(2) == 0) along = along - unit * dot(along, unit);  // along the face
    sphere.along_m = narrow(along);
    sphere.axes = static_cast<uint32_t>(random.below(3));
    sphere.axis[0] = narrow(unit * (random.below(2) == 0 ? -0.999999 : 0.999999));
    const Point any = random_vector(random);
    sphere.axis[1] = narrow(any * (1 / (length(any) + 1e-3)));
    const float part = mesh::sweep(baked.view, sphere, query::kUnlimited).free_part;
    CHECK(part >= 0.0f && part <= 1.0f);
    seen.whole += part >= 1.0f, seen.partly += part > 0.0f && part < 1.0f,
        seen.none += part <= 0.0f;
    if (!(part > 0.0f)) continue;
    const double truth =
        clearance(baked.view, wide(sphere.from_m), wide(sphere.along_m) * double{part});
    CHECK_LE(double{sphere.radius_m} + double{baked.view.head().rounding_m}, truth);
  }
  return seen;
}

// A slab between z = -1 and 0, of 800 triangles on its top, and a step of 1 at x > 2.
tools::Surface step() {
  tools::Surface surface;
  const int n = 20;
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j)
      surface.vertices.push_back(
          {static_cast<float>(i) * 0.1f, static_cast<float>(j) * 0.1f - 1, 0.0f});
  const auto at = [](int i, int j) { return static_cast<uint32_t>(i * (n + 1) + j); };
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      surface.faces.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      surface.faces.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  const auto first = static_cast<uint32_t>(surface.vertices.size());
  for (const float z : {0.0f, 1.0f})
    for (const float y : {-1.0f, 1.0f}) surface.vertices.push_back({2.0f, y, z});
  surface.faces.push_back({first, first + 2, first + 1});
  surface.faces.push_back({first + 1, first + 2, first + 3});
  return surface;
}

}  // namespace

TEST(SweptSphere_FreePart_IsFree) {
  Seen all;
  tools::Surface turned = tools::to_surface(tools::make_cad(5));
  for (Vec3& v : turned.vertices)
    v = {0.6f * v.x - 0.8f * v.z, 0.28f * (0.8f * v.x + 0.6f * v.z) - 0.96f * v.y,
         0.96f * (0.8f * v.x + 0.6f * v.z) + 0.28f * v.y};
  const BakedMesh models[] = {BakedMesh(tools::make_part(1, 2000)),
                              BakedMesh(tools::to_surface(tools::make_cad(3))), BakedMesh(turned)};
  CHECK(models[2].view.box_frame() != nullptr);
  for (uint64_t m = 0; m < 3; ++m) {
    const Seen seen = check_ways(models[m], m, 1500);
    all.whole += seen.whole, all.partly += seen.partly, all.none += seen.none;
  }
  CHECK_LT(1000u, all.whole);
  CHECK_LT(900u, all.partly);
}

TEST(SweptSphere_AlongAFaceOfManyTriangles_IsFreeUpToTheWall) {
  tools::MeshOptions options;
  options.is_signed = false;
  const BakedMesh baked(step(), options);
  for (const float radius_m : {0.0f, 0.001f, 0.03f, 0.2f}) {
    query::SweptSphere sphere;
    sphere.radius_m = radius_m;
    sphere.from_m = {0.3f, 0.13f, radius_m + 1e-6f * static_cast<float>(baked.size)};
    sphere.along_m = {1.2f, 0.31f, 0.0f};
    sphere.axis[0] = {0.0f, 0.0f, -1.0f};
    sphere.axes = 1;
    CHECK_EQ(mesh::sweep(baked.view, sphere, query::kUnlimited).free_part, 1.0f);
    sphere.along_m = {2.2f, 0.31f, 0.0f};
    const double part = double{mesh::sweep(baked.view, sphere, query::kUnlimited).free_part};
    const double closed = (2.0 - 0.3 - double{radius_m}) / 2.2;
    CHECK_LE(part, closed + 1e-9);
    CHECK_LE(0.99 * closed, part);  // a triangle of the wall is seen askew
  }
}

TEST(SweptSphere_HostileWays_AreNotFreeAndTakeNoMoreThanTheBudget) {
  const BakedMesh baked(tools::make_part(1, 2000));
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = HUGE_VALF;
  const float values[] = {nan, inf, -inf, FLT_MAX, 1e20f, 0.0f};
  for (const float value : values)
    for (int where = 0; where < 4; ++where)
      for (const uint32_t work : {0u, 1u, 5u, 40u, 1000000u}) {
        query::SweptSphere sphere;
        sphere.from_m = {0.0f, 0.0f, 0.1f};
        sphere.along_m = {0.001f, 0.0f, 0.0f};
        sphere.radius_m = 0.001f;
        sphere.axes = 1;
        if (where == 0) sphere.from_m.y = value;
        if (where == 1) sphere.along_m.z = value;
        if (where == 2) sphere.radius_m = value;
        if (where == 3) sphere.axis[0].x = value;
        query::Budget budget;
        budget.work = work;
        const mesh::Sweep sweep = mesh::sweep(baked.view, sphere, budget);
        CHECK_LE(sweep.work, work);
        CHECK(sweep.free_part >= 0.0f && sweep.free_part <= 1.0f);
        const bool is_finite = value - value <= 0.0f && std::fabs(value) <= 1.0f;
        if (where < 3 && !is_finite) CHECK_EQ(sweep.free_part, 0.0f);
      }
}
