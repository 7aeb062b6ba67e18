#pragma once
// Kinds of boxes that a tree's nodes may hold, with their bounds. Freestanding: the same code is
// measured on this machine and counted on the controller.
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/grid.hpp"
#include "firmtouch/mesh/layout.hpp"

namespace firmtouch::lab::orders {

using math::Vec3;

/// Distances along three axes to the nearer and the farther side of a box, whichever side of them
/// the query is on.
struct Sides {
  float near_m[3], far_m[3];
};

/// Square of the distance to the farthest corner: no point in the box is farther.
static inline float farthest2_m2(const Sides& s) {
  return s.far_m[0] * s.far_m[0] + s.far_m[1] * s.far_m[1] + s.far_m[2] * s.far_m[2];
}

/// Every side of a box touches the surface within it, so a point of the surface is no farther than
/// the farthest point of the nearer side along the best axis. `slack_m`: how far a side may be from
/// what touches it.
/// Source: Roussopoulos, Kelley, Vincent 1995, "Nearest neighbor queries", definition 4.
static inline float minmax2_m2(const Sides& s, float slack_m) {
  const float all2 = farthest2_m2(s);
  float least2 = all2;
  for (int k = 0; k < 3; ++k) {
    const float touch_m = s.near_m[k] + slack_m;
    const float one2 = all2 - s.far_m[k] * s.far_m[k] + touch_m * touch_m;
    if (one2 < least2) least2 = one2;
  }
  return least2;
}

static inline void put_sides(float to_low, float to_high, float& near_m, float& far_m) {
  const float a = to_low < 0 ? -to_low : to_low, b = to_high < 0 ? -to_high : to_high;
  near_m = a < b ? a : b;
  far_m = a < b ? b : a;
}

/// Lower bounds of float boxes as keys that order as the squared distance.
struct FloatKeys {
  static uint32_t key_of(float distance2_m2) {
    return math::bits_of(distance2_m2 * mesh::kRoundDown);
  }
  // The next float: a box at no distance is kept where the best is none either.
  static uint32_t prune_key(float distance2_m2) {
    return math::bits_of(distance2_m2 * (2.0f - mesh::kRoundDown)) + 1;
  }
};

/// Axis-aligned, 15-bit coordinates on the mesh's grid: what the firmware stores.
struct GridBox {
  uint32_t word[3];
};
template <class Bound>
struct GridQueryOf {
  Bound bound;
  float cells[3];
  float cell_m;

  bool begin(const mesh::Head& head, Vec3 p_m) {
    const float per_cell = 1.0f / head.cell_m;
    cell_m = head.cell_m;
    cells[0] = (p_m.x - head.grid_low_m[0]) * per_cell;
    cells[1] = (p_m.y - head.grid_low_m[1]) * per_cell;
    cells[2] = (p_m.z - head.grid_low_m[2]) * per_cell;
    if constexpr (Bound::kCompensated) {  // outside of the grid: in floats, for any query
      bound.begin(head, p_m);
      return true;
    } else {
      return bound.begin(head, p_m);
    }
  }
  uint32_t key(const GridBox& box) const { return bound.key(box.word); }
  uint32_t prune_key(float distance2_m2) const { return bound.prune_key(distance2_m2); }
  Sides sides(const GridBox& box) const {
    Sides s;
    for (int k = 0; k < 3; ++k) {
      const float low = static_cast<float>(box.word[k] & 0xFFFFu);
      const float high = static_cast<float>(mesh::kGridMax - (box.word[k] >> 16));
      put_sides((cells[k] - low) * cell_m, (cells[k] - high) * cell_m, s.near_m[k], s.far_m[k]);
    }
    return s;
  }
  // A stored side was rounded outward by up to a cell and 2^-6.
  float touch_slack_m(const GridBox&) const { return 1.05f * cell_m; }
};
using GridQuery = GridQueryOf<mesh::NearBound>;  // in integers; false where it is outside the grid
using FarGridQuery = GridQueryOf<mesh::FarBound>;

/// Axis-aligned, floats.
struct FloatBox {
  Vec3 low_m, high_m;
};
struct FloatQuery : FloatKeys {
  Vec3 p_m;

  bool begin(const mesh::Head&, Vec3 at_m) {
    p_m = at_m;
    return true;
  }
  static float outside(float low, float high, float x) {
    const float below = low - x, above = x - high;
    const float most = below > above ? below : above;
    return most > 0.0f ? most : 0.0f;
  }
  uint32_t key(const FloatBox& box) const {
    const Vec3 d{outside(box.low_m.x, box.high_m.x, p_m.x),
                 outside(box.low_m.y, box.high_m.y, p_m.y),
                 outside(box.low_m.z, box.high_m.z, p_m.z)};
    return key_of(dot(d, d));
  }
  Sides sides(const FloatBox& box) const {
    Sides s;
    put_sides(p_m.x - box.low_m.x, p_m.x - box.high_m.x, s.near_m[0], s.far_m[0]);
    put_sides(p_m.y - box.low_m.y, p_m.y - box.high_m.y, s.near_m[1], s.far_m[1]);
    put_sides(p_m.z - box.low_m.z, p_m.z - box.high_m.z, s.near_m[2], s.far_m[2]);
    return s;
  }
  float touch_slack_m(const FloatBox&) const { return 0; }
};

/// Oriented: the paper's. The half sides are a little more than the triangles need (build.hpp).
struct OrientedBox {
  Vec3 centre_m, axis[3], half_m;
};
constexpr float kOrientedSlack = 1e-6f;  // of the sum of the half sides: float32 in the box's frame
struct OrientedQuery : FloatKeys {
  Vec3 p_m;

  bool begin(const mesh::Head&, Vec3 at_m) {
    p_m = at_m;
    return true;
  }
  uint32_t key(const OrientedBox& box) const {
    const Vec3 from = p_m - box.centre_m;
    const Vec3 d{FloatQuery::outside(-box.half_m.x, box.half_m.x, dot(box.axis[0], from)),
                 FloatQuery::outside(-box.half_m.y, box.half_m.y, dot(box.axis[1], from)),
                 FloatQuery::outside(-box.half_m.z, box.half_m.z, dot(box.axis[2], from))};
    return key_of(dot(d, d));
  }
  Sides sides(const OrientedBox& box) const {
    const Vec3 from = p_m - box.centre_m;
    const float half[3] = {box.half_m.x, box.half_m.y, box.half_m.z};
    Sides s;
    for (int k = 0; k < 3; ++k) {
      const float x = dot(box.axis[k], from);
      put_sides(x + half[k], x - half[k], s.near_m[k], s.far_m[k]);
    }
    return s;
  }
  float touch_slack_m(const OrientedBox& box) const {
    return 4 * kOrientedSlack * (box.half_m.x + box.half_m.y + box.half_m.z);
  }
};

}  // namespace firmtouch::lab::orders
