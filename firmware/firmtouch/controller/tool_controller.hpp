#pragma once
#include "firmtouch/controller/compensated_device.hpp"
#include "firmtouch/controller/mesh_tool.hpp"
#include "firmtouch/controller/objects_controller.hpp"

namespace firmtouch {

template <class Mesh>
using SurfacesWithTool = Surfaces<MeshTool, MeshObjects, Mesh, SplineSurface>;

using EveryDevice = CompensatedDevice<DeratedDevice<RedundantDevice<IndexedDevice>>>;

/// Every part of the library, several objects, materials of triangles, a tool of several
/// spheres (part `tool`), index pulses, second encoders, thermal limits and balancing springs
/// (parts `index_pulses`, `second_encoders`, `derating`, `compensation`). The same parameters, and
/// the same bits for an asset without any of these. What the simulator runs.
class ToolController : public WithObjects<EveryDevice, SurfacesWithTool<FullMaterialMesh>> {
 public:
  const MeshTool& tool() const { return surface<MeshTool>(); }
  /// That the tool or its one sphere touches.
  const mesh::View& mesh() const { return tool().is_open() ? tool().mesh() : EveryPart::mesh(); }
};

/// With room for the next asset.
using SwappingToolController =
    EveryPart<TwoScenes, EveryDevice, FullMaterialMesh, SurfacesWithTool<FullMaterialMesh>>;

}  // namespace firmtouch
