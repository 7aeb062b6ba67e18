#include "firmtouch/mesh/segment_cast.hpp"

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::mesh {
namespace {

using math::Vec3;

// Beyond this an end's squares times a triangle's would leave the range of float; no model is
// larger than 1e6 m.
constexpr float kBeyond_m = 1e9f;

float axis_of(Vec3 v, uint32_t k) { return k == 0 ? v.x : k == 1 ? v.y : v.z; }
float absolute(float v) { return v < 0.0f ? -v : v; }
float larger(float a, float b) { return a > b ? a : b; }
float smaller(float a, float b) { return a < b ? a : b; }

/// Entry of the segment into boxes on the mesh's grid, never later than the true one.
///
/// In cells the origin has an error of 2^-24 |origin|, the box check's rounding is 2^-9: boxes are
/// widened by more than both; the quotient's three roundings are covered by kWiden. An axis along
/// which the segment does not move gets a large finite inverse, so that a box that holds the
/// origin's coordinate stays open and any other is far away.
class BoxEntry {
 public:
  BoxEntry(const Head& head, Vec3 a_m, Vec3 along_m) {
    constexpr float kStill = 1e-30f;
    const float per_cell = 1.0f / head.cell_m;
    for (uint32_t k = 0; k < 3; ++k) {
      origin_[k] = (axis_of(a_m, k) - head.grid_low_m[k]) * per_cell;
      const float along = axis_of(along_m, k) * per_cell;
      inverse_[k] = absolute(along) > kStill ? 1.0f / along : 1e30f;
      slack_[k] = absolute(origin_[k]) * 0x1p-22f + 0x1p-6f;
    }
  }

  /// Result: false where the segment passes by before `t_limit`.
  bool enters(const uint32_t* box, float t_limit, float& t_in) const {
    float t_out = t_limit;
    t_in = 0.0f;
    for (uint32_t k = 0; k < 3; ++k) {
      const float low = static_cast<float>(box[k] & 0xFFFFu) - slack_[k];
      const float high = static_cast<float>(kGridMax - (box[k] >> 16)) + slack_[k];
      const float t0 = (low - origin_[k]) * inverse_[k], t1 = (high - origin_[k]) * inverse_[k];
      t_in = larger(t_in, smaller(t0, t1) * (1.0f - kWiden));
      t_out = smaller(t_out, larger(t0, t1) * (1.0f + kWiden));
    }
    return t_in <= t_out;
  }

 private:
  static constexpr float kWiden = 4.0f * 0x1p-24f;
  float origin_[3], inverse_[3], slack_[3];
};

/// The triangle test in the segment's own frame: the origin at a, sheared so that the segment runs
/// along an axis.
class Shear {
 public:
  Shear(Vec3 a_m, Vec3 along_m) : a_m_(a_m) {
    const float x = absolute(along_m.x), y = absolute(along_m.y), z = absolute(along_m.z);
    z_ = x > y ? (x > z ? 0 : 2) : (y > z ? 1 : 2);
    x_ = z_ == 2 ? 0 : z_ + 1;
    y_ = x_ == 2 ? 0 : x_ + 1;
    per_z_ = 1.0f / axis_of(along_m, z_);
    shear_x_ = axis_of(along_m, x_) * per_z_;
    shear_y_ = axis_of(along_m, y_) * per_z_;
  }

  /// Result: true and t where the segment's line crosses the triangle at 0 <= t <= 1. The side of
  /// an edge is the same number with the other sign for the edge's other triangle, so that no
  /// segment slips between the two.
  bool crosses(Vec3 a, Vec3 b, Vec3 c, float& t) const {
    const Vec3 p = sheared(a), q = sheared(b), r = sheared(c);
    const float u = r.x * q.y - r.y * q.x, v = p.x * r.y - p.y * r.x, w = q.x * p.y - q.y * p.x;
    if ((u < 0.0f || v < 0.0f || w < 0.0f) && (u > 0.0f || v > 0.0f || w > 0.0f)) return false;
    const float sum = u + v + w;
    if (!(sum < 0.0f || sum > 0.0f)) return false;
    t = (u * p.z + v * q.z + w * r.z) / sum;
    return t >= 0.0f && t <= 1.0f;
  }

 private:
  Vec3 sheared(Vec3 vertex_m) const {
    const Vec3 v = vertex_m - a_m_;
    const float z = axis_of(v, z_);
    return {axis_of(v, x_) - shear_x_ * z, axis_of(v, y_) - shear_y_ * z, z * per_z_};
  }

  Vec3 a_m_;
  uint32_t x_, y_, z_;
  float per_z_, shear_x_, shear_y_;
};

struct Pending {
  float t_in;
  uint32_t child;
};

void cast_at_leaf(const View& mesh, const Shear& shear, uint32_t leaf, Hit& hit) {
  const uint32_t first = leaf_first(leaf);
  for (uint32_t i = first; i < first + leaf_count(leaf); ++i) {
    const Triangle<uint32_t> triangle = mesh.triangle(i);
    float t;
    if (!shear.crosses(mesh.vertex(triangle.corner[0]), mesh.vertex(triangle.corner[1]),
                       mesh.vertex(triangle.corner[2]), t))
      continue;
    if (hit.hit && !(t < hit.t || (t <= hit.t && i < hit.triangle))) continue;
    hit.hit = true;
    hit.t = t;
    hit.triangle = i;
  }
}

}  // namespace

Hit cast_segment(const View& mesh, Vec3 a_m, Vec3 b_m, query::Budget budget) {
  Hit hit;
  const float limit2 = kBeyond_m * kBeyond_m;
  if (!(dot(a_m, a_m) <= limit2 && dot(b_m, b_m) <= limit2)) return hit;
  const Vec3 along_m = b_m - a_m;
  hit.exact = true;
  if (!(dot(along_m, along_m) > 0.0f)) return hit;  // a point crosses nothing
  const BoxEntry entry(mesh.head(), a_m, along_m);
  const Shear shear(a_m, along_m);
  const uint32_t allowed = budget.steps == 0 ? 1 : budget.steps;
  Pending pending[kMaxDepth + 1];
  uint32_t count = 0;
  pending[count++] = {0.0f, 0};
  while (count > 0) {
    const Pending now = pending[--count];
    if (now.t_in > hit.t) continue;
    if (hit.steps == allowed) {
      hit.exact = false;
      break;
    }
    ++hit.steps;
    if (is_leaf(now.child)) {
      cast_at_leaf(mesh, shear, now.child, hit);
      continue;
    }
    const Node& node = mesh.nodes()[now.child];
    float t0, t1;
    const bool in0 = entry.enters(node.box[0], hit.t, t0),
               in1 = entry.enters(node.box[1], hit.t, t1);
    const uint32_t nearer = in1 && (!in0 || t1 < t0) ? 1 : 0;
    if (in0 && in1) pending[count++] = {nearer != 0 ? t0 : t1, node.child[nearer ^ 1]};
    if (in0 || in1) pending[count++] = {nearer != 0 ? t1 : t0, node.child[nearer]};
  }
  return hit;
}

}  // namespace firmtouch::mesh
