#pragma once
#include <stdint.h>

#include "firmtouch/field/view.hpp"
#include "firmtouch/hull/base_hull.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/mesh/closest_point.hpp"
#include "firmtouch/mesh/hint.hpp"
#include "firmtouch/query/certificate.hpp"
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/servo/local_model.hpp"

namespace firmtouch::scene {

/// A mesh, its pose (mesh frame to device frame) and its material. Objects may share a mesh. The
/// last two are read only where the arguments of touch_mesh() say so, and may be null or not open.
template <class Pose>
struct MeshWithPose {
  const mesh::View* mesh = nullptr;
  Pose pose;
  Material material;
  const field::View* distance_field = nullptr;  // proven against the mesh
  const hull::BaseHull* base_hull = nullptr;    // encloses the mesh
};
using MeshObject = MeshWithPose<math::RigidTransform>;
/// Of a mesh that nothing turns: the same bits in fewer instructions.
using PlacedMesh = MeshWithPose<math::Translation>;

/// State of a (tool, object) pair from tick to tick, and the result of its last query. The caller
/// owns one a pair.
struct MeshTouch {
  mesh::Hint hint;
  mesh::Closest closest;         // mesh frame; has no point if only the distance field was read
  math::Vec3 normal;             // of the plane, device frame
  float penetration_m = 0;       // of the sphere; 0 in free space, and if the sign is unknown
  bool is_of_base_hull = false;  // the mesh query ran out of budget: contact with the base hull
  uint32_t base_hull_steps = 0;
};

/// Penalty contact of a sphere of `radius_m` at `position_m` (device frame) with the mesh.
/// The depth is the signed distance of the centre; without an exact query, no more than its
/// certificate proves. No plane is made for an unknown sign.
/// The normal points from the closest point to the centre (inside: the other way). It turns without
/// a jump over edges and vertices. Near the surface, where that direction is lost to rounding, it
/// fades into the pseudonormal.
/// While the tool is certainly outside, the query is a band query of 2 % of the diagonal beyond the
/// sphere. Farther off no plane is made, and the free radius is at least that.
/// Known limit of penalty contact: a wall thinner than twice the penetration is pushed through.
/// The arguments say what else of the object is used, if it has it.
/// Distance field: in free space one look-up replaces the query; the free radius is then all that
/// the field certifies.
/// Base hull: if the query is not exact and the sphere may be in contact, it renders contact with
/// the base hull, as deep as the mesh's certificate allows. Force then begins early by the gap
/// between hull and mesh, never late, and is never less deep than contact with the mesh. If the
/// base hull's own query has no result either, contact is as without it.
/// Bounds: one query of at most `budget` and about 380 instructions; with a base hull another of as
/// many work units, or 1,280 if that is more. Re-entrant for different touches.
template <bool kHasField = false, bool kHasBaseHull = false>
void touch_mesh(const MeshObject& object, float radius_m, math::Vec3 position_m,
                query::Budget budget, MeshTouch& touch, servo::LocalModel& model);

}  // namespace firmtouch::scene
