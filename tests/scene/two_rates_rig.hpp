#pragma once
// Tools and objects at two rates: servo moves the proxy by the last model while the next one is
// made, from where the hand was up to 20 ticks ago. Every move is cast against all triangles in
// double.
#include <cmath>
#include <cstdint>
#include <vector>

#include "firmtouch/servo/proxy_spring.hpp"
#include "scene/objects_rig.hpp"
#include "scene/tool_rig.hpp"

namespace firmtouch::scene_test {

struct Point {
  double m[3];
  explicit Point(Vec3 a = {})
      : m{static_cast<double>(a.x), static_cast<double>(a.y), static_cast<double>(a.z)} {}
};

// Six times the volume of a tetrahedron.
inline double volume(const Point& a, const Point& b, const Point& c, const Point& d) {
  double u[3], v[3], w[3];
  for (int k = 0; k < 3; ++k)
    u[k] = b.m[k] - a.m[k], v[k] = c.m[k] - a.m[k], w[k] = d.m[k] - a.m[k];
  return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
         u[2] * (v[0] * w[1] - v[1] * w[0]);
}

// All triangles of a mesh, without a tree. A proxy is clear of them by far more than what rounding
// makes of a volume of 1e-22 m3.
class AllTriangles {
 public:
  explicit AllTriangles(const mesh::View& view) {
    for (uint32_t i = 0; i < view.head().triangle_count; ++i)
      for (const uint32_t corner : view.triangle(i).corner)
        corners_.push_back(Point(view.vertex(corner)));
  }
  bool are_crossed(const Point& from, const Point& to) const {
    for (size_t i = 0; i < corners_.size(); i += 3)
      if (is_in_box(&corners_[i], from, to) && is_crossed(&corners_[i], from, to)) return true;
    return false;
  }

 private:
  static bool is_in_box(const Point* t, const Point& from, const Point& to) {
    for (int k = 0; k < 3; ++k) {
      const double low = std::fmin(t[0].m[k], std::fmin(t[1].m[k], t[2].m[k]));
      const double high = std::fmax(t[0].m[k], std::fmax(t[1].m[k], t[2].m[k]));
      if (low > std::fmax(from.m[k], to.m[k]) || high < std::fmin(from.m[k], to.m[k])) return false;
    }
    return true;
  }
  static bool is_crossed(const Point* t, const Point& from, const Point& to) {
    if (volume(t[0], t[1], t[2], from) * volume(t[0], t[1], t[2], to) > 0) return false;
    double least = 1, most = -1;
    for (int k = 0; k < 3; ++k) {
      const double side = volume(from, to, t[k], t[(k + 1) % 3]);
      least = std::fmin(least, side), most = std::fmax(most, side);
    }
    return least >= -1e-22 || most <= 1e-22;
  }

  std::vector<Point> corners_;
};

// A hand that wanders at up to 10 m/s, and now and then is elsewhere.
struct WildHand {
  Draw& draw;
  float reach_m;
  double step_m;
  Vec3 at_m, way_m;
  WildHand(Draw& its_draw, float its_reach_m)
      : draw(its_draw), reach_m(its_reach_m), step_m(draw.below(2) == 0 ? 0.0057 : 0.001) {
    at_m = {0, 0, reach_m};
  }
  void move(uint32_t tick) {
    if (tick % 50 == 0) way_m = draw.within(draw.below(4) == 0 ? step_m : 0.0005);
    if (draw.below(400) == 0) at_m = draw.within(0.7 * static_cast<double>(reach_m));
    at_m = at_m + way_m;
    if (math::length(at_m) > reach_m) way_m = at_m * -0.02f;
  }
};

// What servo requests, and when its model is made: as controller/controller_core.cpp.
struct Late {
  uint32_t most_ticks = 0, due = 0, last = 0;
  bool is_requested = false, has_proxy = false;
  Vec3 hand_m, proxy_m;
  // Result: whether the requested model is made behind this tick.
  bool tick(uint32_t number, Vec3 at_m, const servo::LocalModel& model, Draw& draw) {
    if (!is_requested) {
      hand_m = at_m;
      has_proxy = model.spring.is_used;
      proxy_m = servo::proxy_at(model.spring, at_m);
      due = number + draw.below(most_ticks + 1);
    }
    is_requested = number < due;
    return !is_requested;
  }
  float passed_s(uint32_t number) {
    const uint32_t ticks = number - last + 1;
    last = number;
    return 0.001f * static_cast<float>(ticks);
  }
};

struct Count {
  uint32_t moves = 0, crossings = 0, lost = 0, unsound = 0, loaded = 0;

  void cast(const AllTriangles& all, const Point& from, const Point& to) {
    ++moves;
    crossings += all.are_crossed(from, to) ? 1u : 0u;
  }
  // `went_on`: nothing allowed it to begin anew.
  void made(const servo::LocalModel& model, const scene::Proxy& proxy, bool went_on) {
    const bool is_free = proxy.phase == scene::Proxy::Phase::kFree;
    lost += went_on && !is_free && !model.is_squeezed ? 1u : 0u;
    loaded += is_free && proxy.is_loaded ? 1u : 0u;
    unsound += servo::is_sound(model) ? 0u : 1u;
  }
};

inline scene::ProxyContact usual_contact() {
  scene::ProxyContact contact;
  contact.material.stiffness_N_per_m = 1000;
  contact.is_on = true;
  return contact;
}
inline void take(const Late& late, scene::ProxyContact& contact) {
  contact.position_m = late.hand_m;
  contact.proxy_m = late.proxy_m;
  contact.has_proxy = late.has_proxy;
}
// Else contact begins anew.
inline bool does_go_on(const scene::Proxy& proxy, const scene::ProxyContact& contact) {
  return proxy.phase == scene::Proxy::Phase::kFree && contact.has_proxy &&
         (contact.is_on || !proxy.is_loaded);
}

// One sphere on one mesh, as scene::touch_by_proxy().
struct LateProxy : ProxyRig {
  AllTriangles all{view};
  scene::ProxyTouch touch;
  scene::ProxyContact contact = usual_contact();
  servo::LocalModel model;
  Count count;

  using ProxyRig::ProxyRig;
  void make(const Late& late) {
    scene::Proxy& its = touch.proxy;
    take(late, contact);
    bool goes_on = does_go_on(its, contact);
    const bool went_on = goes_on;
    Vec3 seen_m = its.position_m;
    const auto see = [&] {
      goes_on = goes_on && its.phase == scene::Proxy::Phase::kFree;
      if (goes_on) count.cast(all, Point(seen_m), Point(its.position_m));
      seen_m = its.position_m;
    };
    model = {};
    const scene::ProxySettings its_settings = scene::begin_proxy_contact(contact, touch);
    see();
    const scene::MeshTouched shape{object, hint};
    scene::ProxyMove move(its_settings, shape.size_m(), contact.position_m, its);
    for (; move.aim(); see()) move.take(scene::nearest_of(shape, move));
    const scene::ProxyMoved its_moved = move.finish();
    see();
    scene::end_proxy_contact(contact, its_moved, touch, model);
    count.made(model, its, went_on);
  }
  void servo_moves(Vec3 at_m) {
    if (!model.spring.is_used || model.spring.is_held) return;
    const Vec3 to_m = servo::proxy_at(model.spring, at_m);
    count.cast(all, Point(model.spring.anchor_m), Point(to_m));
  }
};

// A tool that goes on with servo's place of the spring.
struct LateTool : ToolRig {
  AllTriangles all{view};
  Count count;

  using ToolRig::ToolRig;
  void make(const Late& late) {
    take(late, contact);
    for (uint32_t i = 0; i < spheres.size(); ++i) {
      goes_on_[i] = does_go_on(of(i), contact);
      seen_m_[i] = of(i).position_m;
    }
    model = {};
    scene::touch_by_tool(contact, stored(), turn.rotation, *this, touch, model);
    for (uint32_t i = 0; i < spheres.size(); ++i) {
      see(i);
      count.made(model, of(i), goes_on_[i]);
    }
  }
  // Where nothing holds the spring, servo takes the spheres along with it.
  void servo_moves(Vec3 at_m) {
    if (!model.spring.is_used || model.spring.is_held) return;
    const Vec3 way_m = servo::proxy_at(model.spring, at_m) - model.spring.anchor_m;
    for (uint32_t i = 0; i < spheres.size(); ++i)
      if (is_free(i)) count.cast(all, Point(of(i).position_m), Point(of(i).position_m + way_m));
  }

  // As touch_by_tool() sees the mesh.
  scene::Near near(uint32_t sphere, Vec3 x_m, query::Budget budget, float needed_m) {
    see(sphere);
    return scene::MeshTouched{object, hints[sphere]}.near(x_m, budget, needed_m);
  }
  float free_part(uint32_t sphere, scene::Way way, query::Budget budget, uint32_t& work) {
    see(sphere);
    return scene::free_part_of(object, way, budget, work);
  }

 private:
  void see(uint32_t i) {
    if (goes_on_[i] && is_free(i) && distance(seen_m_[i], of(i).position_m) > 0)
      count.cast(all, Point(seen_m_[i]), Point(of(i).position_m));
    seen_m_[i] = of(i).position_m;
  }

  Vec3 seen_m_[scene::kMaxSpheres];
  bool goes_on_[scene::kMaxSpheres] = {};
};

// Objects, in each of whose frames the proxy's moves are cast.
struct LateObjects : ObjectsRig {
  std::vector<AllTriangles> all;
  Count count;

  void make(const Late& late) {
    scene::Proxy& proxy = touch.touch.proxy;
    take(late, contact);
    const bool went_on = goes_on_ = does_go_on(proxy, contact);
    for (scene::Object& object : objects) scene::advance(object, contact.passed_s);
    model = {};
    scene::ObjectsTick tick(contact, {objects.data(), pairs.data(), size()}, scene_m, touch);
    while (tick.carry()) {
      const scene::ObjectQuery& q = tick.query();
      tick.take_bound(near(q.object, q.x_m, q.budget, q.needed_m));
    }
    see();
    scene::NearestObject<ObjectsRig> nearest{tick, *this};
    scene::ProxyMove move(tick.settings(), scene_m, tick.goal_m(), proxy);
    for (; move.aim(); see()) move.take(scene::nearest_of(nearest, move));
    const scene::ProxyMoved moved = move.finish();
    see();
    tick.finish(moved, model);
    see();
    count.made(model, proxy, went_on);
  }
  // Between two models objects stand.
  void servo_moves(Vec3 hand_m) {
    if (!model.spring.is_used || model.spring.is_held) return;
    const Point from(model.spring.anchor_m), to(servo::proxy_at(model.spring, hand_m));
    for (uint32_t i = 0; i < size(); ++i)
      count.cast(all[shape_of[i]], in_object(i, from), in_object(i, to));
  }

 private:
  uint32_t size() const { return static_cast<uint32_t>(objects.size()); }
  bool is_free() const { return touch.touch.proxy.phase == scene::Proxy::Phase::kFree; }
  Point in_object(uint32_t i, const Point& at) const {
    const math::RigidTransform& pose = objects[i].pose;
    const Point t(pose.translation_m);
    Point own;
    for (int k = 0; k < 3; ++k) own.m[k] = 0;
    for (int k = 0; k < 3; ++k) {
      const Point row(pose.rotation.row[k]);
      for (int l = 0; l < 3; ++l) own.m[l] += row.m[l] * (at.m[k] - t.m[k]);
    }
    return own;
  }
  Point of_object(uint32_t i, const Point& own) const {
    const math::RigidTransform& pose = objects[i].pose;
    Point at(pose.translation_m);
    for (int k = 0; k < 3; ++k) {
      const Point row(pose.rotation.row[k]);
      for (int l = 0; l < 3; ++l) at.m[k] += row.m[l] * own.m[l];
    }
    return at;
  }
  void see() {
    const uint8_t frame = touch.carrier;
    const Point own(touch.touch.proxy.position_m);
    const Point at = frame == scene::kNoObject ? own : of_object(frame, own);
    goes_on_ = goes_on_ && is_free();
    seen_.resize(size());
    for (uint32_t i = 0; i < size(); ++i) {
      const Point to = i == frame ? own : in_object(i, at);
      if (goes_on_) count.cast(all[shape_of[i]], seen_[i], to);
      seen_[i] = to;
    }
  }

  std::vector<Point> seen_;  // in each object's frame
  bool goes_on_ = false;
};

}  // namespace firmtouch::scene_test
