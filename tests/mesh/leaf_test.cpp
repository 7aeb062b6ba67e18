// Triangles measured side by side have the bits of triangles measured in turn.
#include "firmtouch/mesh/leaf.hpp"

#include <float.h>
#include <stdint.h>

#include "harness/test.hpp"

namespace math = firmtouch::math;
namespace mesh = firmtouch::mesh;

namespace {

uint32_t g_seed = 7;
uint32_t next_random() {
  g_seed ^= g_seed << 13, g_seed ^= g_seed >> 17, g_seed ^= g_seed << 5;
  return g_seed;
}
float unit() { return static_cast<float>(next_random() >> 8) * 0x1p-23f - 1.0f; }
// Few values, so that regions' borders, ties and zeros of both signs come often.
float coarse() {
  const float values[] = {-1.0f, -0.5f, -0.0f, 0.0f, 0.5f, 1.0f, 2.0f, 0x1p-70f};
  return values[next_random() & 7u];
}
float coordinate(bool is_coarse) { return is_coarse ? coarse() : unit(); }

constexpr uint32_t kVertices = 10, kTriangles = 7;
struct Leaf {
  mesh::Vertex vertices[kVertices];
  mesh::Triangle<uint16_t> triangles[kTriangles];
  math::Vec3 p_m;

  explicit Leaf(uint32_t turn) {
    const bool is_coarse = turn % 2 == 0;
    for (mesh::Vertex& v : vertices)
      v = {coordinate(is_coarse), coordinate(is_coarse), coordinate(is_coarse)};
    for (mesh::Triangle<uint16_t>& t : triangles)
      for (uint16_t& corner : t.corner) corner = static_cast<uint16_t>(next_random() % kVertices);
    p_m = {coordinate(is_coarse) * 2.0f, coordinate(is_coarse), coordinate(is_coarse)};
    if (turn % 8 == 1) vertices[1] = vertices[0];  // two triangles that tie
    if (turn % 8 == 3) p_m.z = 50.0f;
  }
};

bool same(float a, float b) {
  return math::bits_of(a) == math::bits_of(b) || (!(a <= a) && !(b <= b));
}
bool same(math::Vec3 a, math::Vec3 b) { return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z); }

}  // namespace

TEST(TrianglesSideBySideHaveTheBitsOfTheOne) {
  uint32_t differ = 0, seen[7] = {};
  for (uint32_t turn = 0; turn < 4000; ++turn) {
    const Leaf leaf(turn);
    const auto corner = [&](uint32_t k) {
      const mesh::Triangle<uint16_t>* t = leaf.triangles;
      return math::gather(&leaf.vertices[t[0].corner[k]].x_m, &leaf.vertices[t[1].corner[k]].x_m,
                          &leaf.vertices[t[2].corner[k]].x_m, &leaf.vertices[t[3].corner[k]].x_m);
    };
    const mesh::Feet feet = mesh::closest_on_triangles(leaf.p_m, corner(0), corner(1), corner(2));
    const math::Mask4 features = feet.features();
    for (uint32_t lane = 0; lane < 4; ++lane) {
      math::Vec3 at[3];
      for (uint32_t k = 0; k < 3; ++k) {
        const mesh::Vertex& v = leaf.vertices[leaf.triangles[lane].corner[k]];
        at[k] = {v.x_m, v.y_m, v.z_m};
      }
      const mesh::Foot foot = mesh::closest_on_triangle(leaf.p_m, at[0], at[1], at[2]);
      const math::Vec3 offset_m{feet.offset_m.x[lane], feet.offset_m.y[lane],
                                feet.offset_m.z[lane]};
      const uint32_t feature = static_cast<uint32_t>(features[lane]);
      if (!same(offset_m, foot.offset_m) || !same(feet.distance2_m2[lane], foot.distance2_m2) ||
          feature != static_cast<uint32_t>(foot.feature))
        ++differ;
      ++seen[static_cast<uint32_t>(foot.feature)];
    }
  }
  CHECK_EQ(differ, 0u);
  for (const uint32_t times : seen) CHECK(times > 100u);
}

TEST(ALeafSideBySideTellsWhatALeafInTurnTells) {
  mesh::Head head{};
  head.longest_edge_m = 4.0f;
  const mesh::Loss loss(head);
  uint32_t differ = 0, improved = 0;
  for (uint32_t turn = 0; turn < 4000; ++turn) {
    const Leaf leaf(turn);
    const uint32_t first = turn % 3, count = 1 + turn % (kTriangles - first);
    const uint32_t child = mesh::make_leaf(first, count);
    const float bound2_m2 = turn % 5 == 0 ? 0.25f : FLT_MAX;
    mesh::Best a, b, c;
    const float in_turn = mesh::measure_leaf<false>(leaf.vertices, leaf.triangles, loss, leaf.p_m,
                                                    child, 5, true, bound2_m2, a);
    const float side_by_side =
        mesh::measure_side_by_side(leaf.vertices, leaf.triangles, leaf.p_m, child, 5, bound2_m2, b);
    const float chosen = mesh::measure_leaf<false>(leaf.vertices, leaf.triangles, loss, leaf.p_m,
                                                   child, 5, false, bound2_m2, c);
    const mesh::Best* const others[] = {&b, &c};
    for (const mesh::Best* other : others) {
      if (!same(a.offset_m, other->offset_m) || !same(a.distance2_m2, other->distance2_m2) ||
          a.triangle != other->triangle || a.place != other->place || a.feature != other->feature)
        ++differ;
    }
    if (!same(in_turn, side_by_side) || !same(in_turn, chosen)) ++differ;
    improved += in_turn < bound2_m2 ? 1u : 0u;
  }
  CHECK_EQ(differ, 0u);
  CHECK(improved > 3000u);
}
