#pragma once
// Random triangles of a leaf, with few distinct values, and their closest points one by one.

#include <stdint.h>

#include "firmtouch/mesh/leaf.hpp"

namespace firmtouch::mesh_test {

inline uint32_t g_seed = 7;
inline uint32_t random_bits() {
  g_seed ^= g_seed << 13, g_seed ^= g_seed >> 17, g_seed ^= g_seed << 5;
  return g_seed;
}
inline float unit() { return static_cast<float>(random_bits() >> 8) * 0x1p-23f - 1.0f; }
// Few values, so that regions' borders, ties and zeros of both signs come often.
inline float coarse() {
  const float values[] = {-1.0f, -0.5f, -0.0f, 0.0f, 0.5f, 1.0f, 2.0f, 0x1p-70f};
  return values[random_bits() & 7u];
}
inline float coordinate(bool is_coarse) { return is_coarse ? coarse() : unit(); }

constexpr uint32_t kVertices = 10, kTriangles = 9;
struct Leaf {
  mesh::Vertex vertices[kVertices];
  mesh::Triangle<uint16_t> triangles[kTriangles];
  math::Vec3 p_m;

  explicit Leaf(uint32_t turn) {
    const bool is_coarse = turn % 2 == 0;
    for (mesh::Vertex& v : vertices)
      v = {coordinate(is_coarse), coordinate(is_coarse), coordinate(is_coarse)};
    for (mesh::Triangle<uint16_t>& t : triangles)
      for (uint16_t& corner : t.corner) corner = static_cast<uint16_t>(random_bits() % kVertices);
    p_m = {coordinate(is_coarse) * 2.0f, coordinate(is_coarse), coordinate(is_coarse)};
    if (turn % 8 == 1) vertices[1] = vertices[0];  // two triangles that tie
    if (turn % 8 == 3) p_m.z = 50.0f;
  }
};

inline bool same(float a, float b) {
  return math::bits_of(a) == math::bits_of(b) || (!(a <= a) && !(b <= b));
}
inline bool same(math::Vec3 a, math::Vec3 b) {
  return same(a.x, b.x) && same(a.y, b.y) && same(a.z, b.z);
}

inline math::Vec3 corner(const Leaf& leaf, uint32_t triangle, uint32_t k) {
  const mesh::Vertex& v = leaf.vertices[leaf.triangles[triangle].corner[k]];
  return {v.x_m, v.y_m, v.z_m};
}
inline mesh::Foot closest_on(const Leaf& leaf, uint32_t i) {
  return mesh::closest_on_triangle(leaf.p_m, corner(leaf, i, 0), corner(leaf, i, 1),
                                   corner(leaf, i, 2));
}

inline float longest_edge_m(const Leaf& leaf) {
  float longest_m = 0;
  for (uint32_t i = 0; i < kTriangles; ++i)
    for (uint32_t k = 0; k < 3; ++k) {
      const float edge_m = math::length(corner(leaf, i, (k + 1) % 3) - corner(leaf, i, k));
      longest_m = edge_m > longest_m ? edge_m : longest_m;
    }
  return longest_m;
}

inline float measured_one_by_one(const Leaf& leaf, uint32_t child, float min2_m2,
                                 mesh::Best& best) {
  for (uint32_t i = mesh::leaf_first(child), n = mesh::leaf_count(child); n-- > 0; ++i) {
    const mesh::Foot foot = closest_on(leaf, i);
    if (!(foot.distance2_m2 < min2_m2)) continue;
    min2_m2 = foot.distance2_m2;
    best = {min2_m2, foot.offset_m, i, 5, foot.feature};
  }
  return min2_m2;
}

// Turned so that edge 0 is the longest, as the baker turns them.
inline void turn_longest_first(Leaf& leaf) {
  for (mesh::Triangle<uint16_t>& t : leaf.triangles) {
    float longest2_m2 = -1;
    mesh::Triangle<uint16_t> turned = t;
    for (uint32_t k = 0; k < 3; ++k) {
      const mesh::Triangle<uint16_t> now = {
          {t.corner[k], t.corner[(k + 1) % 3], t.corner[(k + 2) % 3]}};
      const mesh::Vertex &u = leaf.vertices[now.corner[0]], &v = leaf.vertices[now.corner[1]];
      const math::Vec3 edge{v.x_m - u.x_m, v.y_m - u.y_m, v.z_m - u.z_m};
      if (math::dot(edge, edge) > longest2_m2) turned = now, longest2_m2 = math::dot(edge, edge);
    }
    t = turned;
  }
}

inline bool same(const mesh::Best& a, const mesh::Best& b) {
  return same(a.offset_m, b.offset_m) && same(a.distance2_m2, b.distance2_m2) &&
         a.triangle == b.triangle && a.slot == b.slot && a.feature == b.feature;
}

}  // namespace firmtouch::mesh_test
