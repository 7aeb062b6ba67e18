#include <algorithm>
#include <cmath>

#include "bake/mesh/bake_mesh.hpp"
#include "firmtouch/scene/material_touch.hpp"
#include "firmtouch/scene/mesh_touched.hpp"
#include "firmtouch/scene/objects.hpp"
#include "host_sim/bench/contact_rows.hpp"
#include "surface/random.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr float kTool_m = 0.003f, kWall_m = 0.04f;
constexpr double kTool_N_per_m = 1000;

scene::ProxyContact contact_at(Vec hand_m, math::Vec3 proxy_m) {
  scene::ProxyContact contact;
  contact.settings.radius_m = kTool_m;
  contact.material.stiffness_N_per_m = static_cast<float>(kTool_N_per_m);
  contact.position_m = tools::to_vec3(hand_m);
  contact.proxy_m = proxy_m;
  contact.has_proxy = contact.is_on = true;
  contact.passed_s = 0.001f;
  return contact;
}

// Of a straight move of the hand: the energy that it is given, and what is stored at its end.
struct Moved {
  double given_J = 0, stored_J = 0;
};

// A floor of two plates that meet, and a wall at its end: rigid, soft, and between.
struct ThreePlates {
  std::vector<tools::Section> sections;
  mesh::View view;
  scene::MeshObject shape;
  mesh::Hint hint[3];
  scene::Object object[3];
  scene::ObjectPair pair[3];
  scene::ObjectsTouch touch;
  servo::LocalModel model;

  ThreePlates() {
    tools::MeshReport report;
    sections = tools::bake_mesh(surface_of(plate(0.04), {}), "plate", {}, report);
    if (!tools::open_baked(sections, "plate", view).ok())
      throw Refused("a plate of the bench: " + report.problem);
    shape.mesh = &view;
    object[0].pose.translation_m = {-0.04f, 0, 0};
    object[1].pose.translation_m = {0.04f, 0, 0};
    object[1].stiffness_N_per_m = 500;
    object[2].pose.translation_m = {kWall_m, 0, 0};
    object[2].pose.rotation = {{{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}};
    object[2].stiffness_N_per_m = 2000;
    for (int i = 0; i < 3; ++i) pair[i].pose = object[i].pose;
  }
  float size_m() const { return 0.3f; }
  scene::Near near(uint32_t i, math::Vec3 x_m, query::Budget budget, float needed_m) {
    return scene::MeshTouched{shape, hint[i]}.near(x_m, budget, needed_m);
  }
  void begin(Vec hand_m) {
    touch = {};
    at_m = hand_m;
    at_N = force_N(hand_m);
  }
  // Between bends the force is linear, so the sum over trapezoids is exact.
  Moved move(Vec to_m) {
    const Vec next_N = force_N(to_m);
    const double stiffness = static_cast<double>(model.spring.stiffness_N_per_m);
    const Moved moved{0.5 * dot(at_N + next_N, to_m - at_m),
                      stiffness > 0 ? 0.5 * dot(next_N, next_N) / stiffness : 0};
    at_m = to_m, at_N = next_N;
    return moved;
  }

 private:
  // Force on the hand.
  Vec force_N(Vec hand_m) {
    const scene::ProxyContact contact = contact_at(hand_m, touch.anchor_m);
    model = {};
    scene::touch_objects(contact, {object, pair, 3}, *this, touch, model);
    const servo::ProxySpring& spring = model.spring;
    if (!spring.is_held) return {};
    const Vec pull_m = tools::to_point(spring.anchor_m) - tools::to_point(contact.position_m);
    return pull_m * static_cast<double>(spring.stiffness_N_per_m);
  }

  Vec at_m, at_N;
};

// A mesh with the same floor and wall, by materials of its triangles. They change in the middle of
// a contact, and the force with them in each tick. Between ticks it is that of a spring, whose
// energy depends on its stretch alone.
struct ThreeMaterials {
  std::vector<tools::Section> sections;
  mesh::View view;
  scene::StoredMaterials materials;
  scene::MaterialMeshObject object;
  mesh::Hint hint;
  scene::ProxyTouch touch;
  scene::MaterialTouch state;
  servo::LocalModel model;

  explicit ThreeMaterials(std::vector<scene::TextureLayout> textures = {}) {
    tools::Surface surface = surface_of(floor_and_wall(), {});
    for (const tools::Face& face : surface.faces) {
      double x_m = 0;
      for (const uint32_t v : face) x_m += static_cast<double>(surface.vertices[v].x) / 3;
      surface.material.push_back(x_m > 0.039 ? 2 : x_m > 0 ? 1 : 0);
    }
    tools::MeshOptions options;
    options.textures = std::move(textures);
    for (const float stiffness : {500.0f, 2000.0f}) {
      scene::MaterialLayout material = {};
      material.name[0] = static_cast<char>('a' + options.materials.size());
      material.stiffness_N_per_m = stiffness;
      options.materials.push_back(material);
    }
    tools::MeshReport report;
    sections = tools::bake_mesh(surface, "floor", options, report);
    if (!tools::open_baked(sections, "floor", view).ok() ||
        !scene::open(tools::sections_of<scene::MaterialSections>(sections, "floor"), view,
                     materials)
             .ok())
      throw Refused("a floor of the bench: " + report.problem);
    object.mesh = &view;
    object.materials = &materials;
  }
  float size_m() const { return view.head().diagonal_m; }
  void begin(Vec hand_m) {
    touch = {}, state = {};
    (void)move(hand_m);
  }
  Moved move(Vec to_m) {
    const scene::MaterialTouch before = state;
    const double before_J = stored_J(before);
    model = {};
    scene::MeshTouchedWith<false, false, scene::MaterialMeshObject> shape{object, hint};
    at_m = tools::to_vec3(to_m);
    scene::touch_materials(contact_at(to_m, touch.proxy.position_m), object, shape, touch, state,
                           model);
    stretch_m = tools::length(tools::to_point(touch.proxy.position_m) - tools::to_point(at_m));
    if (!state.is_held) stretch_m = 0;
    return {before_J - stored_J(before), stored_J(state)};
  }

 private:
  double stored_J(const scene::MaterialTouch& by) const {
    const core::Span<const scene::TextureLayout> textures = materials.textures();
    double cut_m = 0;
    if (by.textured != 0 && by.textured <= textures.size())
      cut_m = static_cast<double>(scene::cut_at(textures[by.textured - 1u], at_m).depth_m *
                                  by.texture_share);
    const double over_m = stretch_m - std::max(0.0, cut_m + static_cast<double>(by.law.slack_m));
    return over_m > 0 ? 0.5 * static_cast<double>(by.law.stiffness_N_per_m) * over_m * over_m : 0;
  }

  double stretch_m = 0;
  math::Vec3 at_m;
};

// The same, of a grid and of grooves.
struct ThreeTextures : ThreeMaterials {
  ThreeTextures()
      : ThreeMaterials(
            {{{{{1000, 0, 0}, 5e-5f}, {{0, 1000, 0}, 5e-5f}}}, {{{{0, 300, 400}, 3e-4f}, {}}}}) {}
};

struct Loop {
  double given_J = 0, stored_J = 0;  // by the end; at most
};

// How far the hand is from where the force has a bend: the floor, the wall.
double to_bend_m(Vec at_m) {
  const double r = static_cast<double>(kTool_m), wall = static_cast<double>(kWall_m);
  return std::min(std::fabs(at_m.z - r), std::fabs(at_m.x - (wall - r)));
}

// Five places, the first of them free, in straight lines and back. Near bends the steps are short.
template <class Surface>
Loop loop_of(Surface& surface, tools::Random& random) {
  Vec place[6];
  for (Vec& each : place) {
    each = {random.between(-0.03, 0.039), random.between(-0.02, 0.02),
            random.between(-0.001, 0.008)};
  }
  place[0].x = std::min(place[0].x, 0.03);
  place[0].z = 0.008;
  place[5] = place[0];
  Loop loop;
  surface.begin(place[0]);
  Vec at_m = place[0];
  for (int k = 1; k < 6; ++k) {
    while (norm(place[k] - at_m) > 0) {
      const double left_m = norm(place[k] - at_m);
      const double step_m = std::clamp(0.4 * to_bend_m(at_m), 5e-7, 2e-4);
      at_m = step_m >= left_m ? place[k] : at_m + (place[k] - at_m) * (step_m / left_m);
      const Moved moved = surface.move(at_m);
      loop.given_J += moved.given_J;
      loop.stored_J = std::max(loop.stored_J, moved.stored_J);
    }
  }
  return loop;
}

template <class Surface>
void add_rows(const std::string& what, bool is_long, bench::Report& report) {
  Surface surface;
  tools::Random random(24);
  const int loops = is_long ? 10000 : 1000;
  // A place may be that much nearer than the radius, and is led back under load.
  const double lifted_m = 2e-6 * static_cast<double>(surface.size_m());
  double most_J = 0, least_J = 0, stored_J = 0, share = 0;
  for (int i = 0; i < loops; ++i) {
    const Loop loop = loop_of(surface, random);
    const double largest_N = std::sqrt(2 * kTool_N_per_m * loop.stored_J);
    if (largest_N > 0) share = std::max(share, loop.given_J / (largest_N * lifted_m));
    most_J = std::max(most_J, loop.given_J);
    least_J = std::min(least_J, loop.given_J);
    stored_J = std::max(stored_J, loop.stored_J);
  }
  const std::string most = "largest stored " + bench::number_text(stored_J * 1e3) + " mJ";
  const std::string of = bench::number_text(loops) + " loops, 3 " + what;
  report.bar("energy that a closed loop gives, over what the clearance allows", of, share, "", 1,
             "allowed: force x 2e-6 of the scene");
  report.bar("energy that a closed loop gives, over the largest stored", of, most_J / stored_J, "",
             1e-6, most);
  report.figure("energy that a closed loop takes, over the largest stored", of, -least_J / stored_J,
                "", "where it slides onto another one");
}

}  // namespace

// Closed loops of a hand over surfaces of different stiffness, without friction.
void add_material_rows(bool is_long, bench::Report& report) {
  add_rows<ThreePlates>("stiffnesses", is_long, report);
  add_rows<ThreeMaterials>("materials of one mesh", is_long, report);
  add_rows<ThreeTextures>("materials with textures", is_long, report);
}

}  // namespace firmtouch::host_sim
