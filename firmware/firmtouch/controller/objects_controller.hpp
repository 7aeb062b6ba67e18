#pragma once
#include "firmtouch/controller/full_controller.hpp"
#include "firmtouch/controller/mesh_objects.hpp"

namespace firmtouch {

using SurfacesWithObjects = Surfaces<MeshObjects, FullMesh, SplineSurface>;

/// Every part of the library, and several objects (part `objects`). The same parameters, and the
/// same bits for an asset without objects. What the simulator runs.
class ObjectsController : public EveryPart<OneScene, HomedDevice, SurfacesWithObjects> {
 public:
  const MeshObjects& objects() const { return surface<MeshObjects>(); }
};

/// With room for the next asset.
using SwappingObjectsController = EveryPart<TwoScenes, HomedDevice, SurfacesWithObjects>;

}  // namespace firmtouch
