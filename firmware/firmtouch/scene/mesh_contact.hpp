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

/// A mesh, where it lies (pose: mesh frame to device frame) and how it feels. Any number of objects
/// may share a mesh.
struct MeshObject {
  const mesh::View* mesh = nullptr;
  math::RigidTransform pose;
  Material material;
  const field::View* distance_field =
      nullptr;  // proven against the mesh; or none, or one that is not open
  const hull::BaseHull* base_hull = nullptr;  // that encloses the mesh; likewise
};

/// What a (tool, object) pair remembers from tick to tick, and what its last query said. The caller
/// owns one a pair.
struct MeshTouch {
  mesh::Hint hint;
  mesh::Closest closest;    // mesh frame; without a point where only the map was asked
  math::Vec3 normal;        // of the plane, device frame
  float penetration_m = 0;  // of the sphere; 0 in free space, and where the side is unknown
  bool is_of_base_hull =
      false;  // the mesh's query was not done, so the shell was touched in its place
  uint32_t base_hull_steps = 0;
};

/// Penalty contact of a sphere of `radius_m` at `position_m` (device frame) with the object, by the
/// signed distance of its centre. Never pushes on an unknown side (touch.closest.certificate.sign
/// == 0: no plane is made). The plane's normal is the direction from the closest point to the
/// centre (inside: the other way), which turns without a jump over edges and vertices; close to the
/// surface, where that direction loses its digits, it fades into the pseudonormal. Where the query
/// was not exact, no more depth is rendered than its certificate proves. While the tool is certainly
/// outside, the surface is looked for within 2 % of the diagonal beyond the sphere (a band query):
/// farther off no plane is made, and the free radius is at least that. With a distance map that
/// takes one look-up, and then the free radius is all that the map certifies.
/// With a shell, where the query was not exact and the sphere may be in contact, the shell is touched
/// in place of the mesh, as deep as the sphere reaches into it, but for what the mesh's certificate
/// rules out: force begins early by what lies between the two, never late, and is never less deep
/// than the mesh's contact. What the shell does not tell in its budget is as without it.
/// Known limit of penalty contact: a wall thinner than twice the penetration is pushed through.
/// Bounds: one query of at most `budget` steps, with a shell another one of as many or 512, and
/// about 200 instructions; re-entrant for different touches.
void touch_mesh(const MeshObject& object, float radius_m, math::Vec3 position_m,
                query::Budget budget, MeshTouch& touch, servo::LocalModel& model);

}  // namespace firmtouch::scene
