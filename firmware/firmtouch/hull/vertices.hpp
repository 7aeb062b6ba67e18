#pragma once
// Where the vertices and boxes of a hull lie. For the library's own translation units.

#include "firmtouch/hull/view.hpp"
#include "firmtouch/math/extents.hpp"
#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::hull {

/// A coordinate on the grid: exact, as the grid's points are.
static inline float on_grid(const uint8_t* at, uint32_t bytes, float low_m, float cell_m) {
  const uint32_t two = at[0] | static_cast<uint32_t>(at[1]) << 8;
  const uint32_t steps = bytes == 2 ? two : two | static_cast<uint32_t>(at[2]) << 16;
  return low_m + static_cast<float>(static_cast<int32_t>(steps)) * cell_m;
}
static inline math::Vec3 on_grid(const uint8_t* at, uint32_t bytes, const float* low_m,
                                 float cell_m) {
  return {on_grid(at, bytes, low_m[0], cell_m), on_grid(at + bytes, bytes, low_m[1], cell_m),
          on_grid(at + 2 * bytes, bytes, low_m[2], cell_m)};
}

/// The new vertex of a collapse.
static inline math::Vec3 made_vertex(const View& hull, uint32_t collapse) {
  const Head& head = hull.head();
  return on_grid(hull.coordinates(collapse), head.coordinate_bytes, head.grid_low_m, head.cell_m);
}
/// By number.
static inline math::Vec3 vertex(const View& hull, uint32_t number) {
  const uint32_t mesh_vertices = hull.head().mesh_vertex_count;
  return number < mesh_vertices ? hull.mesh_vertex(number)
                                : made_vertex(hull, number - mesh_vertices);
}
/// By the base hull's own number.
static inline math::Vec3 vertex(const BaseHull& base_hull, uint32_t i) {
  if (!base_hull.is_made(i))
    return {base_hull.kept(i).x_m, base_hull.kept(i).y_m, base_hull.kept(i).z_m};
  return on_grid(base_hull.coordinates(i), base_hull.coordinate_bytes(), base_hull.grid_low_m(),
                 base_hull.cell_m());
}

struct Box {
  float low_m[3], high_m[3];
};

/// The box of a head.
template <class Head>
static inline Box box_of(const Head& head) {
  return {{head.low_m[0], head.low_m[1], head.low_m[2]},
          {head.high_m[0], head.high_m[1], head.high_m[2]}};
}

/// Corners of a face.
struct FacePoints {
  math::Vec3 p_m, q_m, r_m;
};
static inline FacePoints points_of(const View& hull, uint32_t triangle) {
  const mesh::Triangle<uint32_t> t = hull.triangle(triangle);
  return {hull.mesh_vertex(t.corner[0]), hull.mesh_vertex(t.corner[1]),
          hull.mesh_vertex(t.corner[2])};
}
static inline FacePoints points_of(const BaseHull& base_hull, const BaseHull::Leaf& leaf,
                                   uint32_t n) {
  const BaseHullFace face = leaf.faces[n];
  return {vertex(base_hull, leaf.corners[corner_at(face, 0)]),
          vertex(base_hull, leaf.corners[corner_at(face, 1)]),
          vertex(base_hull, leaf.corners[corner_at(face, 2)])};
}

/// Calls use(i) for the triangles of a leaf until one returns false. Result: whether none did.
template <class Use>
static inline bool each_triangle(const View& hull, uint32_t leaf, const Use& use) {
  const uint32_t first = leaf * kLeafTriangles, count = hull.head().mesh_triangle_count;
  const uint32_t end = first + kLeafTriangles < count ? first + kLeafTriangles : count;
  for (uint32_t i = first; i < end; ++i)
    if (!use(i)) return false;
  return true;
}

/// As the baker computed it, to the bit: the proof at open() is of these floats.
static inline Box child_box(const Box& parent, const NodeBox& node) {
  Box box;
  for (uint32_t k = 0; k < 3; ++k) {
    const float unit_m = (parent.high_m[k] - parent.low_m[k]) * 0x1p-8f;
    box.low_m[k] = parent.low_m[k] + static_cast<float>(static_cast<int32_t>(node.low[k])) * unit_m;
    box.high_m[k] =
        parent.high_m[k] - static_cast<float>(static_cast<int32_t>(node.high[k])) * unit_m;
  }
  return box;
}

static inline Box star_box_m(math::Vec3 about_m, float cell_m, const StarBox& star) {
  uint32_t low_bits;
  uint16_t high_bits;
  __builtin_memcpy(&low_bits, star.bits, sizeof low_bits);
  __builtin_memcpy(&high_bits, star.bits + sizeof low_bits, sizeof high_bits);
  const uint32_t reaches[3] = {low_bits, low_bits >> 14,
                               low_bits >> 28 | static_cast<uint32_t>(high_bits) << 4};
  const uint32_t exponent = static_cast<uint32_t>(high_bits) >> 10;
  const float unit_m = cell_m * math::float_of((127u + exponent) << 23);
  const float about[3] = {about_m.x, about_m.y, about_m.z};
  Box box;
  for (uint32_t k = 0; k < 3; ++k) {
    const uint32_t low = reaches[k] & kMaxReach, high = (reaches[k] >> 7) & kMaxReach;
    box.low_m[k] = about[k] - static_cast<float>(static_cast<int32_t>(low)) * unit_m;
    box.high_m[k] = about[k] + static_cast<float>(static_cast<int32_t>(high)) * unit_m;
  }
  return box;
}

static inline bool holds(const Box& box, math::Vec3 p_m) {
  return box.low_m[0] <= p_m.x && p_m.x <= box.high_m[0] && box.low_m[1] <= p_m.y &&
         p_m.y <= box.high_m[1] && box.low_m[2] <= p_m.z && p_m.z <= box.high_m[2];
}
/// Pre: there was a point.
static inline bool holds(const Box& box, const math::Extents& seen) {
  return box.low_m[0] <= seen.low_x && seen.high_x <= box.high_m[0] && box.low_m[1] <= seen.low_y &&
         seen.high_y <= box.high_m[1] && box.low_m[2] <= seen.low_z && seen.high_z <= box.high_m[2];
}

/// Corner numbers of a star's faces, in the order of a record.
struct Star {
  uint32_t link, split;
  uint32_t id[2 + kMaxLink];      // of vertices 2 k and 2 k + 1, then of the link
  uint32_t number[2 + kMaxLink];  // of the same

  Star(const View& hull, uint32_t collapse, const uint8_t* record) {
    const uint32_t head = View::head_of(record);
    link = link_of(head);
    split = split_of(head);
    id[0] = 2 * collapse;
    id[1] = 2 * collapse + 1;
    for (uint32_t i = 0; i < link; ++i) id[2 + i] = hull.id_in(record, 1 + i);
    for (uint32_t i = 0; i < 2 + link; ++i) number[i] = hull.number_of(id[i]);
  }
  uint32_t face_count() const { return link + 2; }
  /// Indices in `id` and `number` of the corners of a face.
  void face(uint32_t i, uint32_t (&corner)[3]) const {
    if (i < link) {
      corner[0] = i < split ? 0 : 1;
      corner[1] = 2 + i;
      corner[2] = i + 1 == link ? 2 : 3 + i;
    } else {
      corner[0] = i == link ? 0 : 1;
      corner[1] = i == link ? 1 : 0;
      corner[2] = i == link ? 2 : 2 + split;
    }
  }
  /// The youngest corner's number: below mesh_vertex_count a triangle of the mesh, else made by
  /// that vertex's collapse.
  uint32_t youngest(const uint32_t (&corner)[3]) const {
    uint32_t most = number[corner[0]];
    if (number[corner[1]] > most) most = number[corner[1]];
    // NOLINTNEXTLINE(clang-analyzer-core*): opening proves that split is below link
    return number[corner[2]] > most ? number[corner[2]] : most;
  }
};

}  // namespace firmtouch::hull
