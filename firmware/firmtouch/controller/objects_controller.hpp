#pragma once
#include "firmtouch/controller/full_controller.hpp"
#include "firmtouch/controller/material_mesh.hpp"
#include "firmtouch/controller/mesh_objects.hpp"

namespace firmtouch {

template <class Mesh>
using SurfacesWithObjects = Surfaces<MeshObjects, Mesh, SplineSurface>;

/// Every part of the library, several objects (part `objects`), and materials of triangles (part
/// `materials`). The same parameters, and the same bits for an asset without either.
template <class Device, class SurfaceList>
class WithObjects : public EveryPart<OneScene, Device, FullMaterialMesh, SurfaceList> {
 public:
  const scene::StoredMaterials& materials() const {
    return this->template surface<FullMaterialMesh>().materials();
  }
  const MeshObjects& objects() const { return this->template surface<MeshObjects>(); }
};
using ObjectsController = WithObjects<HomedDevice, SurfacesWithObjects<FullMaterialMesh>>;

}  // namespace firmtouch
