#include <algorithm>
#include <cmath>

#include "bake/mesh/bake_mesh.hpp"
#include "firmtouch/scene/mesh_touched.hpp"
#include "firmtouch/scene/objects.hpp"
#include "host_sim/bench/contact_rows.hpp"
#include "surface/random.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr float kTool_m = 0.003f, kWall_m = 0.04f;
constexpr double kTool_N_per_m = 1000;

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
  // Force on the hand.
  Vec force_N(Vec hand_m) {
    const auto narrow = [](double a) { return static_cast<float>(a); };
    scene::ProxyContact contact;
    contact.settings.radius_m = kTool_m;
    contact.material.stiffness_N_per_m = static_cast<float>(kTool_N_per_m);
    contact.position_m = {narrow(hand_m.x), narrow(hand_m.y), narrow(hand_m.z)};
    contact.proxy_m = touch.anchor_m;
    contact.has_proxy = contact.is_on = true;
    contact.passed_s = 0.001f;
    model = {};
    scene::touch_objects(contact, {object, pair, 3}, *this, touch, model);
    const servo::ProxySpring& spring = model.spring;
    if (!spring.is_held) return {};
    const math::Vec3 at = spring.anchor_m, is = contact.position_m;
    const auto pull = [&](float a, float b) {
      return static_cast<double>(spring.stiffness_N_per_m) *
             (static_cast<double>(a) - static_cast<double>(b));
    };
    return {pull(at.x, is.x), pull(at.y, is.y), pull(at.z, is.z)};
  }
};

struct Loop {
  double given_J = 0, stored_J = 0;  // by the end; at most
};

// How far the hand is from where the force has a bend: the floor, the wall.
double to_bend_m(Vec at_m) {
  const double r = static_cast<double>(kTool_m), wall = static_cast<double>(kWall_m);
  return std::min(std::fabs(at_m.z - r), std::fabs(at_m.x - (wall - r)));
}

// Five places, the first of them free, in straight lines and back. Between bends the force is
// linear, so the sum over trapezoids is exact; near them the steps are short.
Loop loop_of(ThreePlates& plates, tools::Random& random) {
  Vec place[6];
  for (Vec& each : place) {
    each = {random.between(-0.03, 0.039), random.between(-0.02, 0.02),
            random.between(-0.001, 0.008)};
  }
  place[0].x = std::min(place[0].x, 0.03);
  place[0].z = 0.008;
  place[5] = place[0];
  Loop loop;
  plates.touch = {};
  Vec at_m = place[0], force_N = plates.force_N(at_m);
  for (int k = 1; k < 6; ++k) {
    while (norm(place[k] - at_m) > 0) {
      const double left_m = norm(place[k] - at_m);
      const double step_m = std::clamp(0.4 * to_bend_m(at_m), 5e-7, 2e-4);
      const Vec to_m = step_m >= left_m ? place[k] : at_m + (place[k] - at_m) * (step_m / left_m);
      const Vec next_N = plates.force_N(to_m);
      loop.given_J += 0.5 * dot(force_N + next_N, to_m - at_m);
      const double stiffness = static_cast<double>(plates.model.spring.stiffness_N_per_m);
      if (stiffness > 0)
        loop.stored_J = std::max(loop.stored_J, 0.5 * dot(next_N, next_N) / stiffness);
      at_m = to_m, force_N = next_N;
    }
  }
  return loop;
}

}  // namespace

// Closed loops of a hand over objects of different stiffness, without friction.
void add_material_rows(bool is_long, bench::Report& report) {
  ThreePlates plates;
  tools::Random random(24);
  const int loops = is_long ? 10000 : 1000;
  // A proxy may be that much nearer than its radius, and is led back under load.
  const double lifted_m = 2e-6 * static_cast<double>(plates.size_m());
  double most_J = 0, least_J = 0, stored_J = 0, share = 0;
  for (int i = 0; i < loops; ++i) {
    const Loop loop = loop_of(plates, random);
    const double largest_N = std::sqrt(2 * kTool_N_per_m * loop.stored_J);
    if (largest_N > 0) share = std::max(share, loop.given_J / (largest_N * lifted_m));
    most_J = std::max(most_J, loop.given_J);
    least_J = std::min(least_J, loop.given_J);
    stored_J = std::max(stored_J, loop.stored_J);
  }
  const std::string most = "largest stored " + bench::number_text(stored_J * 1e3) + " mJ";
  const std::string of = bench::number_text(loops) + " loops, 3 stiffnesses";
  report.bar("energy that a closed loop gives, over what the clearance allows", of, share, "", 1,
             "allowed: force x 2e-6 of the scene");
  report.figure("energy that a closed loop gives, over the largest stored", of, most_J / stored_J,
                "", "aimed at 1e-6; " + most);
  report.figure("energy that a closed loop takes, over the largest stored", of, -least_J / stored_J,
                "", "where it slides onto a softer object");
}

}  // namespace firmtouch::host_sim
