#include "host_sim/plant/placed_mesh.hpp"

#include <utility>

namespace firmtouch::host_sim {

Vec PlacedMesh::turned(Vec own) const {
  const math::Vec3* row = object.pose.rotation.row;
  return {dot(tools::to_point(row[0]), own), dot(tools::to_point(row[1]), own),
          dot(tools::to_point(row[2]), own)};
}

Vec PlacedMesh::to_device(Vec own_m) const {
  return turned(own_m) + tools::to_point(object.pose.translation_m);
}

Vec PlacedMesh::to_own(Vec device_m) const {
  const math::Vec3* row = object.pose.rotation.row;
  const Vec off = device_m - tools::to_point(object.pose.translation_m);
  return tools::to_point(row[0]) * off.x + tools::to_point(row[1]) * off.y +
         tools::to_point(row[2]) * off.z;
}

Vec PlacedMesh::vertex_m(uint32_t i) const { return to_device(tools::to_point(mesh.vertex(i))); }

void PlacedMesh::append_to(std::vector<Vec>& vertices_m,
                           std::vector<std::array<uint32_t, 3>>& triangles) const {
  const auto first = static_cast<uint32_t>(vertices_m.size());
  for (uint32_t i = 0; i < mesh.vertices().size(); ++i) vertices_m.push_back(vertex_m(i));
  for (uint32_t i = 0; i < mesh.head().triangle_count; ++i) {
    const mesh::Triangle<uint32_t> t = mesh.triangle(i);
    triangles.push_back({first + t.corner[0], first + t.corner[1], first + t.corner[2]});
  }
}

MovingMeshes::MovingMeshes(std::vector<PlacedMesh> meshes, float tick_period_s)
    : meshes_(std::move(meshes)), speed_(meshes_.size()), tick_period_s_(tick_period_s) {}

void MovingMeshes::take(const record::TickRecord& record) {
  const uint32_t moved = record.input.command - record::kCommandMoveObject;
  if (moved < speed_.size() && (record.output.state & record::kStateCommandTaken) != 0)
    speed_[moved] = record.input.command_value;
  if ((record.input.flags & record::kFlagModelApart) != 0) return;
  for (size_t i = 0; i < meshes_.size(); ++i)
    if (speed_[i] > 0 || speed_[i] < 0)
      scene::advance(meshes_[i].object, speed_[i] * tick_period_s_);
}

}  // namespace firmtouch::host_sim
