#pragma once
// Several objects, some of which move, and a proxy among them whose every move is observed in the
// frame of each object.
#include <cstdint>
#include <deque>
#include <vector>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/objects.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "scene/draw.hpp"
#include "scene/proxy_rig.hpp"

namespace firmtouch::scene_test {

struct BrokenAmongObjects {
  uint32_t ticks = 0, free = 0, crossings = 0, unclear = 0, longer = 0, over_budget = 0,
           squeezed = 0, unsound = 0, contacts = 0, carried = 0;
};

struct ObjectsRig {
  std::deque<ProxyRig> shapes;     // deque: views are pointed to
  std::vector<uint32_t> shape_of;  // of each object
  std::vector<mesh::Hint> hints;   // of each pair
  std::vector<scene::Object> objects;
  std::vector<scene::ObjectPair> pairs;
  scene::ObjectsTouch touch;
  scene::ProxyContact contact;
  servo::LocalModel model;
  float scene_m = 0.5f;
  uint32_t queries = 0;

  ObjectsRig() {
    contact.settings.radius_m = 0.003f;
    contact.settings.budget.work = 1u << 20;
    contact.material.stiffness_N_per_m = 1000;
    contact.is_on = true;
    contact.passed_s = 0.001f;
  }

  void add_shape(const tools::Surface& surface, bool is_signed = true) {
    shapes.emplace_back(surface, is_signed);
  }
  scene::Object& add(uint32_t shape, const scene::Object& wanted) {
    shape_of.push_back(shape);
    hints.emplace_back();
    objects.emplace_back();
    CHECK(scene::set_object(wanted, objects.back()) == scene::ObjectProblem::kNone);
    pairs.push_back({});
    pairs.back().pose = objects.back().pose;
    return objects.back();
  }

  // As the firmware calls it.
  float size_m() const { return scene_m; }
  scene::Near near(uint32_t object, Vec3 x_m, query::Budget budget, float needed_m) {
    ++queries;
    const scene::MeshTouched shape{shapes[shape_of[object]].object, hints[object]};
    return shape.near(x_m, budget, needed_m);
  }
  float free_part(uint32_t object, scene::Way way, query::Budget budget, uint32_t& work) const {
    return scene::free_part_of(shapes[shape_of[object]].object, way, budget, work);
  }

  // scene::touch_objects(), observed.
  void tick(Vec3 hand_m, BrokenAmongObjects& broken) {
    scene::Proxy& proxy = touch.touch.proxy;
    const bool was_free = proxy.phase == scene::Proxy::Phase::kFree;
    for (scene::Object& object : objects) scene::advance(object, contact.passed_s);
    contact.position_m = hand_m;
    contact.proxy_m = touch.anchor_m;  // servo holds it there
    contact.has_proxy = was_free;
    model = {};
    scene::ObjectsTick tick(contact, {objects.data(), pairs.data(), count()}, scene_m, touch);
    uint32_t work = 0;
    while (tick.carry()) {
      const scene::ObjectQuery& q = tick.query();
      const scene::Near bound = near(q.object, q.x_m, q.budget, q.needed_m);
      work += bound.work;
      tick.take_bound(bound);
    }
    const bool is_observed = was_free && proxy.phase == scene::Proxy::Phase::kFree;
    const bool is_growing = proxy.is_growing;  // pushed, or it began too near: it makes room
    if (is_observed) note(broken);
    const double begin_m = ProxyRig::distance(proxy.position_m, tick.goal_m());
    scene::NearestObject<ObjectsRig> nearest{tick, *this};
    scene::ProxyMove move(tick.settings(), scene_m, tick.goal_m(), proxy);
    while (move.aim()) {
      move.take(scene::nearest_of(nearest, move));
      if (is_observed) note(broken);
    }
    const scene::ProxyMoved moved = move.finish();
    work += moved.work;
    if (is_observed) note(broken);
    const double end_m = ProxyRig::distance(proxy.position_m, tick.goal_m());
    if (is_observed && !is_growing && end_m > begin_m + 1e-7 * static_cast<double>(scene_m))
      ++broken.longer;
    tick.finish(moved, model);
    if (is_observed && proxy.phase == scene::Proxy::Phase::kFree) note(broken);
    // The budget counts a unit at least for each query.
    if (work > contact.settings.budget.work + queries_a_tick()) ++broken.over_budget;
    ++broken.ticks;
    if (touch.carrier != scene::kNoObject) ++broken.carried;
    if (touch.is_squeezed) ++broken.squeezed;
    if (touch.touch.penetration_m > 0) ++broken.contacts;
    if (!servo::is_sound(model)) ++broken.unsound;
    if (proxy.phase != scene::Proxy::Phase::kFree) return;
    ++broken.free;
    for (uint32_t i = 0; i < count(); ++i) at_m[i] = in_object_m(i);
    if (broken.ticks % 16 == 0) check_clearance(broken);
  }

  Vec3 proxy_m() const {
    const Vec3 m = touch.touch.proxy.position_m;
    return touch.carrier == scene::kNoObject ? m : math::apply(objects[touch.carrier].pose, m);
  }

 private:
  std::vector<Vec3> at_m = std::vector<Vec3>(scene::kMaxObjects);  // in each object's frame

  uint32_t count() const { return static_cast<uint32_t>(objects.size()); }
  uint32_t queries_a_tick() const { return count() + scene::kMaxQueries * count(); }

  static double wide(float a) { return static_cast<double>(a); }
  static double part(const math::RigidTransform& pose, int k, const double (&off)[3]) {
    const Vec3* row = pose.rotation.row;
    const auto of = [k](Vec3 a) { return wide(k == 0 ? a.x : k == 1 ? a.y : a.z); };
    return of(row[0]) * off[0] + of(row[1]) * off[1] + of(row[2]) * off[2];
  }
  // In double, by the poses of this tick.
  Vec3 in_object_m(uint32_t i) const {
    const Vec3 m = touch.touch.proxy.position_m;
    if (i == touch.carrier) return m;
    double device[3] = {wide(m.x), wide(m.y), wide(m.z)};
    if (touch.carrier != scene::kNoObject) {
      const math::RigidTransform& pose = objects[touch.carrier].pose;
      const double own[3] = {device[0], device[1], device[2]};
      const Vec3 t = pose.translation_m;
      for (int k = 0; k < 3; ++k) {
        const Vec3 row = pose.rotation.row[k];
        device[k] = wide(row.x) * own[0] + wide(row.y) * own[1] + wide(row.z) * own[2];
      }
      device[0] += wide(t.x), device[1] += wide(t.y), device[2] += wide(t.z);
    }
    const math::RigidTransform& pose = objects[i].pose;
    const Vec3 t = pose.translation_m;
    const double off[3] = {device[0] - wide(t.x), device[1] - wide(t.y), device[2] - wide(t.z)};
    return {static_cast<float>(part(pose, 0, off)), static_cast<float>(part(pose, 1, off)),
            static_cast<float>(part(pose, 2, off))};
  }
  // Where the proxy has come to, relative to each object.
  void note(BrokenAmongObjects& broken) {
    for (uint32_t i = 0; i < count(); ++i) {
      const Vec3 to_m = in_object_m(i);
      if (ProxyRig::distance(at_m[i], to_m) > 0) {
        const mesh::Hit hit =
            mesh::any_crossing(shapes[shape_of[i]].view, at_m[i], to_m, query::kUnlimited);
        if (hit.hit || !hit.exact) ++broken.crossings;
      }
      at_m[i] = to_m;
    }
  }
  void check_clearance(BrokenAmongObjects& broken) const {
    const double needed_m = wide(touch.touch.proxy.radius_m) - 2e-6 * wide(scene_m);
    for (uint32_t i = 0; i < count(); ++i)
      if (shapes[shape_of[i]].truth_m(at_m[i]) < needed_m) ++broken.unclear;
  }
};

}  // namespace firmtouch::scene_test
