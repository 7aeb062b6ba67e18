#pragma once
#include "firmtouch/controller/full_controller.hpp"
#include "firmtouch/controller/material_mesh.hpp"
#include "firmtouch/controller/mesh_objects.hpp"

namespace firmtouch {

template <class Mesh>
using SurfacesWithObjects = Surfaces<MeshObjects, Mesh, SplineSurface>;

/// Every part of the library, several objects (part `objects`), and materials of triangles (part
/// `materials`). The same parameters, and the same bits for an asset without either.
class ObjectsController : public EveryPart<OneScene, HomedDevice, FullMaterialMesh,
                                           SurfacesWithObjects<FullMaterialMesh>> {
 public:
  const scene::StoredMaterials& materials() const {
    return surface<FullMaterialMesh>().materials();
  }
  const MeshObjects& objects() const { return surface<MeshObjects>(); }
};

/// With room for the next asset.
using SwappingObjectsController =
    EveryPart<TwoScenes, HomedDevice, FullMaterialMesh, SurfacesWithObjects<FullMaterialMesh>>;

}  // namespace firmtouch
