#pragma once
// Inside or outside, in the paper's two ways: by the pseudonormal of the closest feature, and by
// the number of triangles that a ray crosses.
#include "firmtouch/mesh/pseudonormal.hpp"
#include "lab/orders/search.hpp"

namespace firmtouch::lab::orders {

/// True where the query is inside, by the stored pseudonormals of a signed mesh.
/// Source: Baerentzen & Aanaes 2005, theorem 1.
static inline bool is_inside(const mesh::View& mesh, const Nearest& nearest) {
  const mesh::Triangle<uint32_t> t = mesh.triangle(nearest.triangle);
  const Vec3 corner[3] = {mesh.vertex(t.corner[0]), mesh.vertex(t.corner[1]),
                          mesh.vertex(t.corner[2])};
  if (mesh::is_vertex(nearest.feature)) {
    const uint32_t k =
        static_cast<uint32_t>(nearest.feature) - static_cast<uint32_t>(mesh::Feature::kVertex0);
    return dot(nearest.offset_m, mesh::decode_vertex_normal(mesh.vertex_normals()[t.corner[k]])) <
           0.0f;
  }
  const Vec3 normal = mesh::unit_normal(corner[0], corner[1], corner[2]);
  if (nearest.feature == mesh::Feature::kFace) return dot(nearest.offset_m, normal) < 0.0f;
  const uint32_t k =
      static_cast<uint32_t>(nearest.feature) - static_cast<uint32_t>(mesh::Feature::kEdge0);
  const Vec3 edge = corner[(k + 1) % 3] - corner[k];
  const int8_t fold = mesh.folds()[nearest.triangle].fold[k];
  return dot(nearest.offset_m, mesh::decode_edge_normal(normal, edge, fold)) < 0.0f;
}

/// A half-line. No component of `along` is zero.
struct Ray {
  Vec3 from_m, along;
};

struct Slab {
  float first = 0, last = FLT_MAX;

  void cut(float from, float along, float low, float high) {
    const float per = 1.0f / along, a = (low - from) * per, b = (high - from) * per;
    const float near = a < b ? a : b, far = a < b ? b : a;
    first = near > first ? near : first;
    last = far < last ? far : last;
  }
  bool is_hit() const { return first <= last; }
};

static inline bool may_cross(const FloatBox& box, const Ray& ray) {
  Slab slab;
  slab.cut(ray.from_m.x, ray.along.x, box.low_m.x, box.high_m.x);
  slab.cut(ray.from_m.y, ray.along.y, box.low_m.y, box.high_m.y);
  slab.cut(ray.from_m.z, ray.along.z, box.low_m.z, box.high_m.z);
  return slab.is_hit();
}

static inline bool may_cross(const OrientedBox& box, const Ray& ray) {
  const Vec3 from = ray.from_m - box.centre_m;
  const float half[3] = {box.half_m.x, box.half_m.y, box.half_m.z};
  Slab slab;
  for (int k = 0; k < 3; ++k) {
    const float along = dot(box.axis[k], ray.along), at = dot(box.axis[k], from);
    // Alongside: within the slab for good, or never.
    if (along * along < 1e-20f) {
      if (at < -half[k] || at > half[k]) return false;
    } else {
      slab.cut(at, along, -half[k], half[k]);
    }
  }
  return slab.is_hit();
}

/// Plain float32, so a ray through an edge may count twice or not at all: what the paper did too.
static inline bool crosses(const Ray& ray, Vec3 a, Vec3 b, Vec3 c) {
  const Vec3 ab = b - a, ac = c - a, across = cross(ray.along, ac), from = ray.from_m - a;
  const float volume = dot(ab, across);
  if (!(volume < 0.0f || volume > 0.0f)) return false;
  const float per = 1.0f / volume, u = dot(from, across) * per;
  const Vec3 turned = cross(from, ab);
  const float v = dot(ray.along, turned) * per, t = dot(ac, turned) * per;
  return u >= 0.0f && v >= 0.0f && u + v <= 1.0f && t > 0.0f;
}

/// How many triangles a ray crosses: odd from inside.
template <class K>
uint32_t crossings(const Tree<K>& tree, const Ray& ray) {
  uint32_t stack[3 * mesh::kMaxDepth + 4];
  uint32_t count = 0, crossed = 0;
  stack[count++] = 0;
  while (count > 0) {
    const uint32_t child = stack[--count];
    if (!mesh::is_leaf(child)) {
      const typename K::Node& node = tree.nodes[child];
      for (uint32_t slot = 0; slot < K::kWays; ++slot)
        if (may_cross(node.box[slot], ray)) stack[count++] = node.child[slot];
      continue;
    }
    const uint32_t first = mesh::leaf_first(child), end = first + mesh::leaf_count(child);
    for (uint32_t i = first; i < end; ++i) {
      const mesh::Triangle<uint32_t> t = tree.mesh->triangle(i);
      if (crosses(ray, tree.mesh->vertex(t.corner[0]), tree.mesh->vertex(t.corner[1]),
                  tree.mesh->vertex(t.corner[2])))
        ++crossed;
    }
  }
  return crossed;
}

}  // namespace firmtouch::lab::orders
