#pragma once
#include <array>
#include <string>
#include <vector>

#include "firmtouch/mesh/view.hpp"
#include "firmtouch/record/tick.hpp"
#include "firmtouch/scene/object.hpp"
#include "host_sim/plant/vec.hpp"

namespace firmtouch::host_sim {

/// A mesh of the scene. One that is touched alone has no name, and stands.
struct PlacedMesh {
  std::string name;
  mesh::View mesh;
  scene::Object object;  // pose: mesh's frame -> device frame

  Vec to_device(Vec own_m) const;
  Vec to_own(Vec device_m) const;
  Vec turned(Vec own) const;  // a direction
  /// In the device frame. Pre: i < mesh.vertices().size().
  Vec vertex_m(uint32_t i) const;
  /// All of it behind what is there, in the device frame.
  void append_to(std::vector<Vec>& vertices_m,
                 std::vector<std::array<uint32_t, 3>>& triangles) const;
};

/// The same meshes as they move, by the ticks of a run. The arithmetic of the motion is the
/// controller's: certificates hold relative to where it has the objects.
class MovingMeshes {
 public:
  MovingMeshes(std::vector<PlacedMesh> meshes, float tick_period_s);
  /// Once for each tick, in order: the poses are then those that it touched.
  void take(const record::TickRecord& record);
  const std::vector<PlacedMesh>& meshes() const { return meshes_; }

 private:
  std::vector<PlacedMesh> meshes_;
  std::vector<float> speed_;  // times the twist
  float tick_period_s_;
};

}  // namespace firmtouch::host_sim
