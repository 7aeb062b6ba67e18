#include "firmtouch/hull/triangle_region.hpp"

namespace firmtouch::hull {
namespace {

using math::Vec3;

float largest(Vec3 v) {
  return mesh::larger(mesh::absolute(v.x), mesh::larger(mesh::absolute(v.y), mesh::absolute(v.z)));
}

// On one side of the plane through `of`, surely: with u = 2^-24 and S the largest coordinate of any
// corner seen from of[0], a product of three is off by less than 32 u S^3 where it is summed.
bool is_aside(const Vec3 (&of)[3], const Vec3 (&other)[3]) {
  const Vec3 e = of[1] - of[0], f = of[2] - of[0], n = cross(e, f);
  float side[3], size = 0.0f;
  for (uint32_t i = 0; i < 3; ++i) {
    const Vec3 v = other[i] - of[0];
    side[i] = dot(n, v);
    size = mesh::larger(size, largest(v));
  }
  size = mesh::larger(size, mesh::larger(largest(e), largest(f)));
  const float error = 0x1p-17f * size * size * size + 1e-36f;
  return (side[0] > error && side[1] > error && side[2] > error) ||
         (side[0] < -error && side[1] < -error && side[2] < -error);
}

}  // namespace

TriangleRegion::TriangleRegion(const Box& bounds, const Vec3 (&corner_m)[3])
    : box_{{corner_m[0].x, corner_m[0].y, corner_m[0].z},
           {corner_m[0].x, corner_m[0].y, corner_m[0].z}} {
  for (uint32_t i = 0; i < 3; ++i) {
    corner_m_[i] = corner_m[i];
    edge_[i] =
        mesh::SegmentFrame(bounds.low_m, bounds.high_m, corner_m[i], corner_m[i == 2 ? 0 : i + 1]);
    const float at[3] = {corner_m[i].x, corner_m[i].y, corner_m[i].z};
    for (uint32_t k = 0; k < 3; ++k) {
      box_.low_m[k] = mesh::smaller(box_.low_m[k], at[k]);
      box_.high_m[k] = mesh::larger(box_.high_m[k], at[k]);
    }
  }
}

bool TriangleRegion::crosses(const FacePoints& face) const {
  const Vec3 other_m[3] = {face.p_m, face.q_m, face.r_m};
  if (is_aside(corner_m_, other_m) || is_aside(other_m, corner_m_)) return false;
  for (const mesh::SegmentFrame& edge : edge_)
    if (edge.crossing(face.p_m, face.q_m, face.r_m).direction != 0) return true;
  // This triangle moved is the other moved the opposite way: seen through the origin, the same way.
  const Vec3 a = -corner_m_[0], b = -corner_m_[1], c = -corner_m_[2];
  for (uint32_t i = 0; i < 3; ++i) {
    const Vec3 from = -other_m[i], to = -other_m[i == 2 ? 0 : i + 1];
    if (mesh::exact_crossing(from, to, a, b, c).direction != 0) return true;
  }
  return false;
}

}  // namespace firmtouch::hull
