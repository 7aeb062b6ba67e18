#include "firmtouch/controller/tool_controller.hpp"
#include "host_sim/plant/environment.hpp"

namespace firmtouch::host_sim {

namespace {

// As the controller places them, in its float32.
std::vector<PlacedMesh> meshes_of(const ToolController& controller, Vec scene_m) {
  const math::Vec3 scene = tools::to_vec3(scene_m), asset = controller.asset_origin_m();
  const math::Vec3 origin{scene.x + asset.x, scene.y + asset.y, scene.z + asset.z};
  std::vector<PlacedMesh> meshes;
  const auto add = [&](const char* name, const mesh::View& mesh, const scene::Object& object) {
    meshes.push_back({name, mesh, object});
    math::Vec3& at_m = meshes.back().object.pose.translation_m;
    at_m = {at_m.x + origin.x, at_m.y + origin.y, at_m.z + origin.z};
  };
  const MeshObjects& objects = controller.objects();
  for (uint32_t i = 0; objects.is_open() && i < objects.stored().size(); ++i)
    add(objects.stored()[i].name, objects.mesh(i), scene::object_of(objects.stored()[i]));
  if (controller.mesh().is_open()) add("", controller.mesh(), {});
  return meshes;
}

}  // namespace

Environment environment_of(const ToolController& controller, Vec scene_m) {
  std::vector<Vec> guide;
  if (controller.curve().is_open())
    for (const curve::Sample& s : controller.curve().samples())
      guide.push_back(
          {static_cast<double>(s.x_m), static_cast<double>(s.y_m), static_cast<double>(s.z_m)});
  constexpr int kPoints = 2000;
  if (guide.empty() && controller.spline_guide().is_open())
    for (int i = 0; i <= kPoints; ++i) {
      const math::Vec3 p = spline::point_at_arc(
          controller.spline_guide(), static_cast<float>(i) / static_cast<float>(kPoints));
      guide.push_back(
          {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
    }
  // Makes the last point equal to the first in every bit, so that the guide counts as closed.
  const bool is_closed = controller.spline_guide().is_open() && !controller.curve().is_open() &&
                         controller.spline_guide().chains().size() == 1 &&
                         controller.spline_guide().chains()[0].is_closed != 0;
  if (is_closed) guide.back() = guide.front();
  Environment environment(meshes_of(controller, scene_m), controller.spline_surface(),
                          std::move(guide), scene_m, tools::to_point(controller.asset_origin_m()));
  std::vector<std::string> materials;
  std::vector<double> stiffness_N_per_m;
  for (const scene::MaterialLayout& material : controller.materials().table()) {
    materials.emplace_back(material.name);
    stiffness_N_per_m.push_back(static_cast<double>(material.stiffness_N_per_m));
  }
  environment.name_materials(std::move(materials));
  environment.set_stiffness(std::move(stiffness_N_per_m));
  const auto copy_of = [](const auto& span) { return std::vector(span.begin(), span.end()); };
  const scene::StoredMaterials& stored = controller.materials();
  environment.set_textures(copy_of(stored.textures()), copy_of(stored.reliefs()),
                           copy_of(stored.samples()));
  const scene::StoredTool& spheres = controller.tool().spheres();
  environment.set_tool({spheres.begin(), spheres.end()});
  return environment;
}

}  // namespace firmtouch::host_sim
