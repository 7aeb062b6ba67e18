#pragma once
#include <string>
#include <utility>
#include <vector>

#include "firmtouch/scene/texture.hpp"
#include "firmtouch/scene/tool_layout.hpp"
#include "firmtouch/spline/view.hpp"
#include "host_sim/plant/placed_mesh.hpp"
#include "host_sim/plant/spline_shape.hpp"
#include "host_sim/plant/vec.hpp"

namespace firmtouch {
class ToolController;
}

namespace firmtouch::host_sim {

/// Surface and guide in the device's frame, as the simulated hand and the report see them.
class Environment {
 public:
  Environment() = default;
  /// Meshes in the device frame, or open spline surfaces, or neither; and a polyline `guide_m`.
  /// These two are moved by `scene_m`, and by what the asset's coordinates count from.
  Environment(std::vector<PlacedMesh> meshes, const spline::View& surface, std::vector<Vec> guide_m,
              Vec scene_m, Vec asset_origin_m = {});

  struct Surface {
    Vec point_m, normal;
    double distance_m = 0;  // signed, negative inside
  };
  bool has_surface() const { return has_mesh() || surface_.is_open(); }
  bool has_mesh() const { return !meshes_.empty(); }
  /// Of objects that move where they begin.
  Surface nearest(Vec from_m) const;

  bool has_guide() const { return guide_m_.size() > 1; }
  double guide_length_m() const { return arc_m_.empty() ? 0 : arc_m_.back(); }
  /// Point of the guide at arc length `arc_m`. Beyond the end a closed guide continues from its
  /// start, an open one runs backwards.
  Vec guide_at(double arc_m) const;
  const std::vector<Vec>& guide_m() const { return guide_m_; }
  /// Pre: has_mesh(). The first mesh.
  const mesh::View& mesh() const { return meshes_.front().mesh; }
  const std::vector<PlacedMesh>& meshes() const { return meshes_; }
  uint32_t triangle_count() const;  // of all meshes
  /// Names of the materials of the mesh's triangles; empty: they have none.
  const std::vector<std::string>& materials() const { return materials_; }
  void name_materials(std::vector<std::string> names) { materials_ = std::move(names); }
  /// Stiffness of each material, FLT_MAX: rigid.
  void set_stiffness(std::vector<double> stiffness_N_per_m) {
    stiffness_N_per_m_ = std::move(stiffness_N_per_m);
  }
  /// Of the contact's spring against a material, from 1; 0: none. The two are in series.
  double spring_N_per_m(uint32_t material, double contact_N_per_m) const;
  /// One a material, or none.
  void set_textures(std::vector<scene::TextureLayout> textures,
                    std::vector<scene::ReliefLayout> reliefs = {},
                    std::vector<uint8_t> samples = {});
  scene::Stiffening stiffening() const;
  /// Slope of the texture of a material, from 1, that the tool has in the device frame; 0: none.
  Vec texture_slope(uint32_t material, Vec tool_m) const;
  const spline::View& surface() const { return surface_; }
  /// Triangles of the spline surfaces, in the asset's frame; empty for a mesh.
  const Tessellation& tessellation() const { return tessellation_; }
  /// Parameter surface_turned: the free side of the spline surfaces is opposite to their normals.
  void turn(bool normals_inward) { normals_inward_ = normals_inward; }
  /// What the asset's coordinates count from, in the device frame.
  Vec origin_m() const { return origin_m_; }
  /// The place of the models' coordinates.
  Vec scene_m() const { return scene_m_; }
  /// Spheres of the asset's tool, in its handle's frame; empty: one sphere at the tip.
  const std::vector<scene::SphereLayout>& tool() const { return tool_; }
  void set_tool(std::vector<scene::SphereLayout> spheres) { tool_ = std::move(spheres); }

 private:
  std::vector<PlacedMesh> meshes_;
  std::vector<std::string> materials_;
  std::vector<double> stiffness_N_per_m_;  // of the materials
  std::vector<scene::TextureLayout> textures_;
  std::vector<scene::ReliefLayout> reliefs_;
  std::vector<uint8_t> samples_;  // of the maps
  spline::View surface_;
  Tessellation tessellation_;
  bool normals_inward_ = false;
  Vec origin_m_, scene_m_;
  std::vector<scene::SphereLayout> tool_;
  std::vector<Vec> guide_m_;
  std::vector<double> arc_m_;
  bool closed_ = false;
};

/// Surface and guide of the controller's asset, moved by `scene_m`.
Environment environment_of(const ToolController& controller, Vec scene_m);

}  // namespace firmtouch::host_sim
