#pragma once
// Boxes turned against the axes, for machined parts that stand askew. For the library's own
// translation units, and for the baker.

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/view.hpp"

namespace firmtouch::mesh {

/// By how much opening requires a turned box to exceed its vertices, in cells.
///
/// Each axis of turned() errs by four roundings of a sum of products, 4 u |p - centre| with u =
/// 2^-24. Of a vertex or a query on the grid that is 4 u 2^15 sqrt(3) / 2 < 3.5 * 2^-9 cells: this
/// covers both. Of a query beyond it, at d >= 3,200 cells from every box, |p - centre| < 8.2 d: the
/// three axes err by 57 u d. The axes shorten every distance by 2^-16, 256 u, so FarBound's
/// derivation holds.
constexpr float kTurnedSlackCells = 0x1p-6f;
constexpr uint32_t kTurnedFreeCells = 3200;

inline math::Vec3 axis_of(const BoxFrame& frame, uint32_t k) {
  return {frame.axis[k][0], frame.axis[k][1], frame.axis[k][2]};
}

/// `v` along the axes of the frame.
inline math::Vec3 along(const BoxFrame& frame, math::Vec3 v) {
  return {dot(axis_of(frame, 0), v), dot(axis_of(frame, 1), v), dot(axis_of(frame, 2), v)};
}

/// `p_m` in the frame.
inline math::Vec3 in_frame(const BoxFrame& frame, math::Vec3 p_m) {
  return along(frame, p_m - math::Vec3{frame.centre_m[0], frame.centre_m[1], frame.centre_m[2]});
}
/// The same, called, so that meshes without a frame do not pay for its registers.
[[gnu::noinline, gnu::cold]] inline math::Vec3 turned(const BoxFrame& frame, math::Vec3 p_m) {
  return in_frame(frame, p_m);
}

/// `p_m` where the grid of the mesh has it.
inline math::Vec3 in_box_frame(const View& mesh, math::Vec3 p_m) {
  return mesh.box_frame() == nullptr ? p_m : turned(*mesh.box_frame(), p_m);
}

}  // namespace firmtouch::mesh
