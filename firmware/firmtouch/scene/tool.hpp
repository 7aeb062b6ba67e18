#pragma once
#include <float.h>
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"
#include "firmtouch/scene/proxy_contact.hpp"
#include "firmtouch/scene/stored_tool.hpp"

// Contact of a tool of several spheres with one shape. scene/README.md has the algorithm and its
// theorems. The shape is a struct of yours with
//
//     scene::Near near(uint32_t sphere, math::Vec3 x_m, query::Budget budget, float needed_m);
//     float size_m() const;
//
// near() is that of scene/touched.hpp; it may keep a hint a sphere. So that small spheres follow a
// fast hand, it may also have
//
//     float free_part(uint32_t sphere, scene::Way way, query::Budget budget, uint32_t& work) const;
namespace firmtouch::scene {

/// Fixed work of one more sphere that is near: four queries of a proxy, as in tick_work.
constexpr uint32_t kSphereWork = 235;
/// The handle turns at most so fast: a sphere on it then moves as a hand does.
constexpr float kMaxToolTurn_rad_per_s = 10.0f;
constexpr float kMaxToolTurn_rad = 6.2831853f;  // of the rotation vector, an axis

/// How the handle is turned: by a rotation vector that follows a wanted one at a limited rate.
struct ToolTurn {
  math::Vec3 wanted_rad, turn_rad;
  math::Mat3 rotation;  // handle -> device frame

  /// Result: false, and nothing changed, if there is no such axis or the angle is out of range.
  bool want(uint32_t axis, float angle_rad);
  void advance(float passed_s);
};

/// State of a tool from tick to tick. The caller owns one a tool.
struct ToolTouch {
  ProxyTouch sphere[kMaxSpheres];
  math::Vec3 place_m[kMaxSpheres];  // of the centres, for the hand of the last tick; device frame
  math::Vec3 anchor_m;              // of the spring of the last model
  math::Vec3 torque_Nm;             // of contact on the handle, about its origin; device frame
  float penetration_m = 0;          // hand to anchor, or depth of a sphere that is led out
  uint32_t steps = 0, work = 0;     // of all queries of the last tick
  uint8_t nearest = 0;              // the sphere with the least room
  uint8_t next = 0;                 // sphere that is moved first in the next tick
};

/// Contact begins anew. In place: no copy stands on the stack.
void reset(ToolTouch& touch);

/// One tick, driven by the caller, who moves the proxies: see touch_by_tool().
class ToolTick {
 public:
  ToolTick(const ProxyContact& contact, StoredTool spheres, const math::Mat3& rotation,
           float size_m, ToolTouch& touch);

  /// Result: whether a sphere is left whose proxy is to be moved.
  bool next();
  uint32_t sphere() const { return sphere_; }
  Proxy& proxy() { return touch_.sphere[sphere_].proxy; }
  const ProxySettings& settings() const { return settings_; }
  math::Vec3 goal_m() const { return contact_.position_m; }
  void end(const ProxyMoved& moved);
  void finish(servo::LocalModel& model);

 private:
  bool drift(ProxyTouch& touch, math::Vec3 to_m, float radius_m) const;
  void choose();
  void begin(uint32_t sphere);
  void add(uint32_t sphere);
  void make_spring();

  const StoredTool spheres_;
  ToolTouch& touch_;
  const math::Vec3 hand_m_;
  const Material whole_;  // of the tool
  const float size_m_;
  ProxyContact contact_;  // of the sphere that moves
  ProxySettings settings_;
  servo::LocalModel made_;  // of all spheres together
  uint32_t sphere_ = 0;
  uint32_t waiting_ = 0;  // bits of the spheres that are to be moved
  uint32_t known_ = 0;    // bits of those that were moved in this tick
  uint32_t allowed_ = 0;  // how many the work allows
  uint32_t work_left_;
  bool is_uncertain_ = false;
  // Sums over the spheres that a surface holds.
  math::Vec3 pull_N_;
  float twice_energy_J_ = 0, longest_m_ = 0;
  float least_room_m_ = FLT_MAX;
};

/// One sphere of the tool, with the shape that it touches.
template <class Shape>
struct OfSphere {
  Shape& shape;
  uint32_t sphere;

  Near near(math::Vec3 x_m, query::Budget budget, float needed_m) {
    return shape.near(sphere, x_m, budget, needed_m);
  }
  template <class S = Shape>
  auto free_part(const Way& way, query::Budget budget, uint32_t& work) const
      -> decltype(static_cast<S&>(shape).free_part(sphere, way, budget, work)) {
    return shape.free_part(sphere, way, budget, work);
  }
  float size_m() const { return shape.size_m(); }
};

/// Contact of a tool of up to 8 spheres, as touch_by_proxy() of one. Each sphere has a proxy of its
/// own and its part of the stiffness, so all together are at most as stiff as `contact.material`.
/// The model has one spring with force and energy of all. A far sphere costs a comparison; the
/// others share the budget, and take turns where it does not allow all: then the model is
/// uncertain. `contact.proxy_m` is not used.
/// Bounds: for each near sphere those of scene/proxy.hpp; kSphereWork of the budget pays for each
/// but one. Re-entrant for different tools.
template <class Shape>
void touch_by_tool(const ProxyContact& contact, StoredTool spheres, const math::Mat3& rotation,
                   Shape& shape, ToolTouch& touch, servo::LocalModel& model) {
  ToolTick tick(contact, spheres, rotation, shape.size_m(), touch);
  while (tick.next()) {
    OfSphere<Shape> sphere{shape, tick.sphere()};
    tick.end(move_proxy(tick.settings(), tick.goal_m(), sphere, tick.proxy()));
  }
  tick.finish(model);
}

}  // namespace firmtouch::scene
