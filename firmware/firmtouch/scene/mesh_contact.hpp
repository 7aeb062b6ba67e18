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

/// A mesh, its pose (mesh frame to device frame) and its material. Any number of objects may share
/// a mesh.
struct MeshObject {
  const mesh::View* mesh = nullptr;
  math::RigidTransform pose;
  Material material;
  // Optional, may be null or not open: a distance field that was proven against the mesh, and a
  // base hull that encloses it.
  const field::View* distance_field = nullptr;
  const hull::BaseHull* base_hull = nullptr;
};

/// State of a (tool, object) pair between ticks, and its last answer. The caller owns one a pair.
struct MeshTouch {
  mesh::Hint hint;
  mesh::Closest closest;         // mesh frame; without a point if only the distance field was read
  math::Vec3 normal;             // of the plane, device frame
  float penetration_m = 0;       // of the sphere; 0 in free space and with an unknown sign
  bool is_of_base_hull = false;  // the mesh's budget ran out, so the base hull was touched instead
  uint32_t base_hull_steps = 0;
};

/// Penalty contact of a sphere of `radius_m` at `position_m` (device frame) with the object, by the
/// signed distance of its centre.
///
/// Normal: the direction from the closest point to the centre, reversed inside. It turns without a
/// jump over edges and vertices. Close to the surface it fades into the pseudonormal.
/// Sign unknown (certificate.sign == 0): no plane. Query not exact: no more depth than the
/// certificate proves.
/// Band: while the tool is outside, the query is exact only within the radius and 2 % of the
/// diagonal. Farther away there is no plane, and the free radius is at least the band; with a
/// distance field it is what the field certifies, for one visit.
/// Base hull: if the query was not exact and the sphere may be in contact, the hull is touched
/// instead, less what the mesh's certificate excludes. Contact then begins early, never late, and
/// is never less deep than the mesh's.
///
/// Pre: radius and material are within the ranges of the parameter table.
/// Bounds: one query of at most `budget`, with a base hull a second one of as many visits or 512,
///         and about 200 instructions; re-entrant for different touches.
/// Result: `touch` and the planes and free radius of `model`.
/// Limit: the tool can be pushed in; a wall thinner than twice the penetration is pushed through.
void touch_mesh(const MeshObject& object, float radius_m, math::Vec3 position_m,
                query::Budget budget, MeshTouch& touch, servo::LocalModel& model);

}  // namespace firmtouch::scene
