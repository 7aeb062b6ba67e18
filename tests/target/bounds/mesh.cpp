#include "firmtouch/field/closest_point.hpp"
#include "firmtouch/field/distance_bounds.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/compensated_distance.hpp"
#include "firmtouch/mesh/exact_crossing.hpp"
#include "firmtouch/mesh/triangle.hpp"
#include "target/bounds/asset.hpp"
#include "target/bounds/meter.hpp"
#include "target/random.hpp"

namespace firmtouch::target {
namespace {

using math::Vec3;

constexpr uint32_t kInputs = 20000;

struct Triangle {
  Vec3 a, b, c;  // a b is the longest edge
};

Triangle triangle_of(Random& random) {
  Vec3 corner[3];
  for (Vec3& at : corner) at = random.cube();
  if (random.below(4) == 0)  // a sliver
    corner[2] = corner[0] + (corner[1] - corner[0]) * random.sign() + random.cube() * 1e-4f;
  uint32_t first = 0;
  float longest2 = -1;
  for (uint32_t k = 0; k < 3; ++k) {
    const Vec3 edge = corner[(k + 1) % 3] - corner[k];
    if (math::dot(edge, edge) > longest2) longest2 = math::dot(edge, edge), first = k;
  }
  return {corner[first], corner[(first + 1) % 3], corner[(first + 2) % 3]};
}

// Off the triangle by a reach that is also too short for floats to find the feature.
Vec3 about(const Triangle& t, Random& random) {
  const float u = random.sign(), v = random.sign();
  const Vec3 on = t.a + (t.b - t.a) * u + (t.c - t.a) * v;
  return on + random.cube() * random.scale(1e-8f, 34);
}

void measure_compensated() {
  Random random(3);
  Worst face, edge, corner, unclear;
  for (uint32_t i = 0; i < kInputs; ++i) {
    const Triangle t = triangle_of(random);
    const Vec3 p = about(t, random);
    const mesh::Foot foot = mesh::closest_on_triangle(p, t.a, t.b, t.c);
    float distance2 = 0;
    const uint32_t taken = instructions_of([&] {
      distance2 = mesh::nearest_compensated2(p, t.a, t.b, t.c, foot.feature, foot.distance2_m2);
    });
    asm volatile("" ::"r"(&distance2) : "memory");
    const bool is_clear = mesh::is_feature_clear(foot.distance2_m2, t.b - t.a);
    Worst& worst = mesh::is_vertex(foot.feature) ? corner
                   : !is_clear                   ? unclear
                   : mesh::is_edge(foot.feature) ? edge
                                                 : face;
    worst.take(taken);
  }
  const char* const header = "mesh/compensated_distance.hpp";
  print_figure(header, face), print_figure(header, edge);
  print_figure(header, corner), print_figure(header, unclear);
}

// Coordinates from `least` to 2^spread of it.
Vec3 spread_point(Random& random, float least, uint32_t spread) {
  const Vec3 at = random.cube();
  return {at.x * random.scale(least, spread), at.y * random.scale(least, spread),
          at.z * random.scale(least, spread)};
}

Worst worst_crossing(uint32_t seed, uint32_t inputs, float least, uint32_t spread) {
  Random random(seed);
  Worst worst;
  mesh::Crossing crossing;
  for (uint32_t i = 0; i < inputs; ++i) {
    Vec3 at[5];
    for (Vec3& point : at) point = spread_point(random, least, spread);
    if (i % 4 == 0) at[0] = at[2];                           // an end on a corner
    if (i % 4 == 1) at[1] = at[2] + (at[3] - at[2]) * 0.5f;  // on an edge
    worst.of([&] { crossing = mesh::exact_crossing(at[0], at[1], at[2], at[3], at[4]); });
    asm volatile("" ::"r"(&crossing) : "memory");
  }
  return worst;
}

void measure_field() {
  const mesh::View& mesh = asset().mesh;
  const mesh::Head& head = mesh.head();
  const Vec3 low_m{head.low_m[0], head.low_m[1], head.low_m[2]};
  const Vec3 size_m = Vec3{head.high_m[0], head.high_m[1], head.high_m[2]} - low_m;
  Random random(4);
  Worst worst;
  field::Bounds bounds;
  for (uint32_t i = 0; i < kInputs; ++i) {
    const Vec3 off = random.cube();
    const Vec3 half_m = size_m * (i % 3 == 0 ? 0.5f : i % 3 == 1 ? 0.6f : 5.0f);
    const Vec3 p_m =
        low_m + size_m * 0.5f + Vec3{off.x * half_m.x, off.y * half_m.y, off.z * half_m.z};
    worst.of([&] { bounds = field::distance_bounds(asset().field, p_m); });
    asm volatile("" ::"r"(&bounds) : "memory");
  }
  print_figure("field/distance_bounds.hpp", worst);
}

}  // namespace

void measure_mesh() {
  measure_compensated();
  print_figure("mesh/exact_crossing.hpp", worst_crossing(5, 4000, 1, 2));
  print_figure("mesh/exact_crossing.hpp", worst_crossing(6, 4000, 0x1p-126f, 252));
  measure_field();
}

}  // namespace firmtouch::target
