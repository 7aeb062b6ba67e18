#pragma once
#include "firmtouch/scene/mesh_contact.hpp"
#include "firmtouch/scene/stored_materials.hpp"
#include "firmtouch/scene/touched.hpp"

namespace firmtouch::scene {

/// A mesh whose triangles have materials.
struct MaterialMeshObject : MeshObject {
  const StoredMaterials* materials = nullptr;  // proven against the mesh, or not open
};

/// Result: see Way, which comes into the mesh frame. `work`: units used are added.
template <class Pose>
float free_part_of(const MeshWithPose<Pose>& object, Way& way, query::Budget budget,
                   uint32_t& work);
extern template float free_part_of(const MeshObject&, Way&, query::Budget, uint32_t&);
extern template float free_part_of(const PlacedMesh&, Way&, query::Budget, uint32_t&);

/// A mesh as a shape that a proxy touches. The distance field and the base hull of the object are
/// read only where the arguments say so, its materials if it is a MaterialMeshObject. Where the
/// work runs out, a base hull certifies what it can: another query of as many units, or 1,280 if
/// that is more, beside those of `budget`.
template <bool kHasField, bool kHasBaseHull, class Object = MeshObject>
struct MeshTouchedWith {
  const Object& object;
  mesh::Hint& hint;  // of the (tool, object) pair

  float size_m() const;
  Near near(math::Vec3 x_m, query::Budget budget, float needed_m) const;
  float free_part(Way way, query::Budget budget, uint32_t& work) const {
    return free_part_of(object, way, budget, work);
  }
};

using MeshTouched = MeshTouchedWith<false, false>;
using PlacedMeshTouched = MeshTouchedWith<false, false, PlacedMesh>;
using HulledMeshTouched = MeshTouchedWith<false, true>;

extern template struct MeshTouchedWith<false, false>;
extern template struct MeshTouchedWith<false, false, PlacedMesh>;
extern template struct MeshTouchedWith<true, false>;
extern template struct MeshTouchedWith<true, false, PlacedMesh>;
extern template struct MeshTouchedWith<false, true>;
extern template struct MeshTouchedWith<false, true, PlacedMesh>;
extern template struct MeshTouchedWith<true, true>;
extern template struct MeshTouchedWith<true, true, PlacedMesh>;
extern template struct MeshTouchedWith<false, false, MaterialMeshObject>;
extern template struct MeshTouchedWith<true, false, MaterialMeshObject>;
extern template struct MeshTouchedWith<false, true, MaterialMeshObject>;
extern template struct MeshTouchedWith<true, true, MaterialMeshObject>;

}  // namespace firmtouch::scene
