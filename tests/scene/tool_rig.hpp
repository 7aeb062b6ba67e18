#pragma once
// A tool of several spheres on one mesh; every move of every proxy is observed.
#include <cmath>
#include <cstdint>
#include <vector>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/tool.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "scene/objects_rig.hpp"

namespace firmtouch::scene_test {

struct BrokenTool {
  uint32_t ticks = 0, free = 0, loaded = 0, crossings = 0, unclear = 0, over_budget = 0,
           unsound = 0, untrue = 0;
  double longer_m = 0;       // a tick, of a proxy away from the hand
  double force_off = 0;      // of the spring from the sum of all, relative
  double energy_off = 0;     // the same of its energy
  double torque_off_Nm = 0;  // of the torque from the sum
  double stiffest = 0;       // of the spring, relative to the setting
};

struct ToolRig : ProxyRig {
  std::vector<scene::SphereLayout> spheres;
  scene::ToolTurn turn;
  scene::ToolTouch touch;
  scene::ProxyContact contact;
  servo::LocalModel model;
  mesh::Hint hints[scene::kMaxSpheres];
  uint32_t queries = 0;
  BrokenTool broken;

  ToolRig(const tools::Surface& surface, std::vector<scene::SphereLayout> its_spheres,
          bool is_signed = true)
      : ProxyRig(surface, is_signed), spheres(std::move(its_spheres)) {
    contact.settings.budget.work = 1u << 20;
    contact.material.stiffness_N_per_m = 1000;
    contact.is_on = true;
    contact.passed_s = 0.001f;
  }

  // As touch_by_tool() sees the mesh.
  scene::Near near(uint32_t sphere, Vec3 x_m, query::Budget budget, float needed_m) {
    ++queries;
    queried_ |= 1u << sphere;
    note(sphere);
    return scene::MeshTouched{object, hints[sphere]}.near(x_m, budget, needed_m);
  }
  float free_part(uint32_t sphere, scene::Way way, query::Budget budget, uint32_t& work) {
    note(sphere);
    return scene::free_part_of(object, way, budget, work);
  }
  float size_m() const { return view.head().diagonal_m; }
  scene::StoredTool stored() const {
    return {spheres.data(), static_cast<uint32_t>(spheres.size())};
  }

  void touch_at(Vec3 hand_m) {
    queries = queried_ = 0;
    turn.advance(contact.passed_s);
    for (uint32_t i = 0; i < spheres.size(); ++i)
      last_m_[i] = of(i).position_m, was_[i] = is_free(i);
    contact.position_m = hand_m;
    contact.proxy_m = touch.anchor_m;
    model = {};
    scene::touch_by_tool(contact, stored(), turn.rotation, *this, touch, model);
    contact.has_proxy = model.spring.is_used;
  }

  void observe(Vec3 hand_m) {
    std::vector<Vec3> before_m;
    for (uint32_t i = 0; i < spheres.size(); ++i) before_m.push_back(of(i).position_m);
    const bool had_proxy = contact.has_proxy;
    touch_at(hand_m);
    ++broken.ticks;
    if (!servo::is_sound(model)) ++broken.unsound;
    uint32_t queried = 0, work = touch.work;
    for (uint32_t i = 0; i < spheres.size(); ++i) queried += queried_ >> i & 1u;
    if (queried > 1) work += (queried - 1) * scene::kSphereWork;
    if (work > contact.settings.budget.work) ++broken.over_budget;
    for (uint32_t i = 0; i < spheres.size(); ++i) {
      note(i);
      if (!is_free(i)) continue;
      ++broken.free;
      broken.loaded += of(i).is_loaded ? 1u : 0u;
      if (had_proxy && was_[i])
        broken.longer_m = std::fmax(broken.longer_m, distance(of(i).position_m, touch.place_m[i]) -
                                                         distance(before_m[i], touch.place_m[i]));
      if (broken.ticks % 16 == 0 &&
          truth_m(of(i).position_m) < wide(of(i).radius_m) - 2e-6 * wide(size_m()))
        ++broken.unclear;
    }
    compare_with_sum();
    if (broken.ticks % 4 == 0) compare_with_truth();
  }

  const scene::Proxy& of(uint32_t i) const { return touch.sphere[i].proxy; }
  bool is_free(uint32_t i) const { return of(i).phase == scene::Proxy::Phase::kFree; }
  Vec3 force_N() const {
    return (model.spring.anchor_m - contact.position_m) * model.spring.stiffness_N_per_m;
  }

 private:
  void note(uint32_t i) {
    if (was_[i] && is_free(i) && distance(last_m_[i], of(i).position_m) > 0) {
      const mesh::Hit hit =
          mesh::any_crossing(view, last_m_[i], of(i).position_m, query::kUnlimited);
      if (hit.hit || !hit.exact) ++broken.crossings;
    }
    last_m_[i] = of(i).position_m;
  }

  // Bounds of the sphere with the least room, against the distance in double.
  void compare_with_truth() {
    const uint32_t i = touch.nearest;
    const scene::Bounds bounds = scene::bounds_of(of(i), touch.place_m[i]);
    const double truth = truth_m(is_free(i) ? of(i).position_m : touch.place_m[i]);
    const double scale = std::fmax(wide(size_m()), truth);
    if (!(wide(bounds.lower_m) <= truth + 1e-7 * scale) ||
        !(wide(bounds.upper_m) >= truth - 4e-7 * scale))
      ++broken.untrue;
  }

  // The spring against the sum over the spheres, in double.
  void compare_with_sum() {
    double force[3] = {}, torque[3] = {}, energy_J = 0, sizes_N = 0;
    for (uint32_t i = 0; i < spheres.size(); ++i) {
      if (!is_free(i) || !of(i).is_loaded) continue;
      const Vec3 at_m = touch.place_m[i], to_m = of(i).position_m;
      const double k = wide(touch.sphere[i].material.stiffness_N_per_m);
      const double f[3] = {k * (wide(to_m.x) - wide(at_m.x)), k * (wide(to_m.y) - wide(at_m.y)),
                           k * (wide(to_m.z) - wide(at_m.z))};
      const Vec3 hand_m = contact.position_m;
      const double arm[3] = {wide(at_m.x) - wide(hand_m.x), wide(at_m.y) - wide(hand_m.y),
                             wide(at_m.z) - wide(hand_m.z)};
      for (int a = 0; a < 3; ++a) {
        const int b = (a + 1) % 3, c = (a + 2) % 3;
        force[a] += f[a];
        torque[a] += arm[b] * f[c] - arm[c] * f[b];
        energy_J += 0.5 * f[a] * f[a] / k;
      }
      sizes_N += std::sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]);
    }
    if (!(sizes_N > 0.1)) return;
    const double size_N =
        std::sqrt(force[0] * force[0] + force[1] * force[1] + force[2] * force[2]);
    const Vec3 is_N = force_N();
    const double off_N =
        std::sqrt(std::pow(wide(is_N.x) - force[0], 2) + std::pow(wide(is_N.y) - force[1], 2) +
                  std::pow(wide(is_N.z) - force[2], 2));
    const double k = wide(model.spring.stiffness_N_per_m);
    // The anchor is rounded to float32: far from the origin by more than a light touch allows.
    const Vec3 anchor_m = model.spring.anchor_m;
    const double rounding_N = k * 0x1p-24 * wide(math::length(anchor_m));
    broken.force_off = std::fmax(broken.force_off, (off_N - rounding_N) / sizes_N);
    const double setting = wide(contact.material.stiffness_N_per_m);
    broken.stiffest = std::fmax(broken.stiffest, k / setting);
    if (size_N > 0.5 * sizes_N)  // they do not balance each other
      broken.energy_off =
          std::fmax(broken.energy_off, std::fabs(0.5 * size_N * size_N / k / energy_J - 1));
    const Vec3 of_tool_Nm = touch.torque_Nm;
    broken.torque_off_Nm =
        std::fmax(broken.torque_off_Nm, std::fabs(wide(of_tool_Nm.x) - torque[0]) +
                                            std::fabs(wide(of_tool_Nm.y) - torque[1]) +
                                            std::fabs(wide(of_tool_Nm.z) - torque[2]));
  }

  Vec3 last_m_[scene::kMaxSpheres];
  bool was_[scene::kMaxSpheres] = {};
  uint32_t queried_ = 0;  // bits of the spheres, in the last tick
};

// Two spheres, `half_m` to either side of the handle along x.
inline std::vector<scene::SphereLayout> bar(float half_m, float radius_m) {
  return {{{-half_m, 0, 0}, radius_m}, {{half_m, 0, 0}, radius_m}};
}

}  // namespace firmtouch::scene_test
