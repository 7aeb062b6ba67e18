#pragma once
// A mesh with materials, and a hand that touches it tick by tick.
#include <cstdio>
#include <functional>
#include <vector>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/material_touch.hpp"
#include "scene/proxy_rig.hpp"

namespace firmtouch::scene_test {

inline scene::MaterialLayout material(const char* name, float stiffness_N_per_m,
                                      float friction_static = 0, float friction_dynamic = 0,
                                      float viscous = 0) {
  scene::MaterialLayout made = {};
  std::snprintf(made.name, sizeof made.name, "%s", name);
  made.stiffness_N_per_m = stiffness_N_per_m;
  made.friction_static = friction_static, made.friction_dynamic = friction_dynamic;
  made.friction_viscous_N_s_per_m = viscous;
  return made;
}

// A plate at z = 0 of material 1 where x < 0, else 2.
inline tools::Surface two_plates() {
  tools::Surface surface;
  extrude({{{-0.04f, 0}, {-0.04f, -0.01f}, {0, -0.01f}, {0.04f, -0.01f}, {0.04f, 0}, {0, 0}},
           {{0, 1, 5}, {1, 2, 5}, {5, 2, 4}, {2, 3, 4}}},
          0.04f, surface);
  return surface;
}

struct MaterialsRig {
  std::vector<tools::Section> sections;
  mesh::View view;
  scene::StoredMaterials materials;
  scene::MaterialMeshObject object;
  mesh::Hint hint;
  scene::ProxyContact contact;
  scene::ProxyTouch touch;
  scene::MaterialTouch state;
  servo::LocalModel model;
  Vec3 before_m;         // where the spring of the model before this one pulled to
  bool is_late = false;  // servo still had that one, as it may at two rates

  // `number_at`: of the material where a face has its middle.
  MaterialsRig(tools::Surface surface, std::vector<scene::MaterialLayout> table,
               const std::function<uint8_t(Vec3)>& number_at,
               std::vector<scene::TextureLayout> textures = {},
               std::vector<scene::ReliefLayout> reliefs = {}, std::vector<uint8_t> samples = {}) {
    for (const tools::Face& face : surface.faces)
      surface.material.push_back(number_at(
          (surface.vertices[face[0]] + surface.vertices[face[1]] + surface.vertices[face[2]]) *
          (1.0f / 3.0f)));
    tools::MeshReport report;
    tools::MeshOptions options;
    options.materials = std::move(table);
    options.textures = std::move(textures);
    options.reliefs = std::move(reliefs);
    options.samples = std::move(samples);
    sections = tools::bake_mesh(surface, "shape", options, report);
    CHECK(report.problem.empty());
    CHECK(tools::open_baked(sections, "shape", view).ok());
    CHECK(
        scene::open(tools::sections_of<scene::MaterialSections>(sections, "shape"), view, materials)
            .ok());
    object.mesh = &view;
    object.materials = &materials;
    contact.settings.radius_m = 0.003f;
    contact.settings.budget.work = 1u << 20;
    contact.material.stiffness_N_per_m = 1000;
    contact.passed_s = 0.001f;
    contact.is_on = true;
  }
  // Force on the hand.
  Vec3 tick(Vec3 hand_m) {
    contact.position_m = hand_m;
    contact.proxy_m = is_late ? before_m : model.spring.anchor_m;
    before_m = model.spring.anchor_m;
    contact.has_proxy = true;
    model = {};
    scene::MeshTouchedWith<false, false, scene::MaterialMeshObject> shape{object, hint};
    scene::touch_materials(contact, object, shape, touch, state, model);
    const servo::ProxySpring& spring = model.spring;
    if (!spring.is_held) return {};
    return (spring.anchor_m - hand_m) * spring.stiffness_N_per_m;
  }
  Vec3 go(Vec3 from_m, Vec3 to_m, uint32_t ticks) {
    Vec3 force_N;
    for (uint32_t i = 1; i <= ticks; ++i)
      force_N =
          tick(from_m + (to_m - from_m) * (static_cast<float>(i) / static_cast<float>(ticks)));
    return force_N;
  }
};

}  // namespace firmtouch::scene_test
