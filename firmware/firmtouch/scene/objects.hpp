#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"
#include "firmtouch/scene/object.hpp"
#include "firmtouch/scene/objects_layout.hpp"
#include "firmtouch/scene/proxy_contact.hpp"

// Contact with several objects, which may move, through one proxy. scene/README.md has the
// algorithm and its theorems. The shapes are a struct of yours with
//
//     scene::Near near(uint32_t object, math::Vec3 x_m, query::Budget budget, float needed_m);
//     float size_m() const;       // of the scene: the largest distance in it
//
// near() answers for one object, in the object's own frame, as a shape of scene/touched.hpp does.
// So that small tools follow a fast hand, it may also have
//
//     float free_part(uint32_t object, const scene::Way& way, query::Budget budget,
//                     uint32_t& work) const;
namespace firmtouch::scene {

constexpr uint8_t kNoObject = 0xFF;
// Units, to search a way: with less most searches end early, and certificates lack what they took.
constexpr uint32_t kMinObjectsWay = 48;

/// State of a (tool, object) pair from tick to tick. The caller owns one a pair. For an object that
/// is new among the others: its pose, and nothing else.
struct ObjectPair {
  math::RigidTransform pose;  // of the object in the last tick
  math::Vec3 at_m;            // a place in the object's frame, and what a query certified there
  float lower_m = 0;
  float left_m = 0;  // certified in the last tick: distance of the object from the proxy
  int8_t sign = 0;
};

/// State of a tool among objects. The caller owns one a tool. While the tool touches an object, the
/// proxy is in that object's frame, which carries it; else in the device frame.
struct ObjectsTouch {
  ProxyTouch touch;
  math::Vec3 anchor_m;      // the proxy at the end of the last tick, device frame
  math::Vec3 bounds_at_m;   // where left_m of the pairs holds, device frame
  float bounds_loss_m = 0;  // that bounds_at_m may be off
  float full_radius_m = 0;  // of a proxy that objects have pushed into less room; 0: none
  uint8_t carrier = kNoObject;
  uint8_t nearest = kNoObject;
  math::Vec3 seen_at_m;  // a place in the frame of `nearest`, and its distance there
  float seen_m = 0;
  float upper_m = 0;  // of the distance from the proxy to the objects, at the end of the last tick
  bool is_squeezed = false;  // in the last tick
  bool was_growing = false;  // before objects pushed it
};

static_assert(sizeof(ObjectsTouch) <= 576 && sizeof(ObjectPair) <= 72);

/// `object` and `pair` have `count` elements, at most kMaxObjects: others are not touched.
struct ObjectSet {
  const Object* object = nullptr;
  ObjectPair* pair = nullptr;
  uint32_t count = 0;
};

/// A query of one object, in that object's frame.
struct ObjectQuery {
  uint32_t object = 0;
  math::Vec3 x_m;
  query::Budget budget;
  float needed_m = 0;
};

/// One tick, driven by the caller, who makes the queries: see touch_objects().
class ObjectsTick {
 public:
  ObjectsTick(const ProxyContact& contact, const ObjectSet& set, float size_m, ObjectsTouch& touch);

  /// Carries the proxy along with what it touches, and out of the way of other objects.
  /// Result: whether query() is needed to go on.
  bool carry();
  void take_bound(const Near& near);

  /// The goal of the proxy's move, in the frame that the proxy is in now.
  math::Vec3 goal_m() const { return contact_.position_m; }
  const ProxySettings& settings() const { return settings_; }

  /// A query of the proxy: of the objects that may be nearest.
  void begin_query(math::Vec3 x_m, query::Budget budget, float needed_m);
  bool next();
  void take(const Near& near);
  Near nearest() const;

  /// The same way in the frame of an object.
  /// Result: whether the object may be in reach of it; if not, `own` is not to be used.
  bool is_in_reach(uint32_t object, const Way& way, Way& own) const;
  uint32_t count() const { return set_.count; }

  void finish(const ProxyMoved& moved, servo::LocalModel& model);

  const ObjectQuery& query() const { return query_; }

 private:
  struct Place {
    uint8_t frame;           // an object's, or kNoObject: the device's
    math::Vec3 m, device_m;  // in that frame; in the device's
    float loss_m;            // what the way to the frame of an object rounds, without its part
  };
  struct Bounds {  // of the distance of each object from a place
    Place place;
    float m[kMaxObjects];
    uint32_t least;  // the object with the least
    float least_m;
  };
  static bool is_set(uint32_t bits, uint32_t i) { return (bits >> i & 1u) != 0; }
  static float length_up_m(math::Vec3 way_m);  // rounded up
  const math::RigidTransform& pose_of(uint8_t frame) const;
  Place place_in(uint8_t frame, math::Vec3 m) const;
  math::Vec3 in_object_m(uint32_t i, const Place& place) const;
  float loss_m(uint32_t i, const Place& place) const;
  float bound_m(uint32_t i, const Place& place) const;
  void make_bounds(const Place& place, Bounds& bounds) const;
  Place carried_by(uint32_t i) const;
  bool has_moved(uint32_t i) const { return (moved_ >> i & 1u) != 0; }
  void leave_out_air();
  bool renew(const Bounds& bounds);
  void keep(float lower_m);
  void enter(const Place& place);
  void drop_moved_features();
  Material material_of(uint32_t i) const;
  bool end_carry(const Bounds& bounds);
  math::Vec3 way_of_carrier() const;
  void shrink(float room_m);
  bool has(const Feature& feature) const;
  bool is_better(const Near& near) const;
  Feature in_frame(const Feature& feature) const;
  uint8_t touched() const;
  void restore_radius();

  const ObjectSet set_;
  ObjectsTouch& touch_;
  Proxy& proxy_;
  const Material tool_;
  ProxyContact contact_;
  ProxySettings settings_;
  const float size_m_;
  math::Vec3 hand_m_;     // device frame
  Place was_;             // of the proxy, before the objects moved
  math::Vec3 carried_m_;  // what objects displace the proxy by, device frame
  bool was_loaded_ = false, is_carried_ = false, is_lost_ = false, is_pushed_ = false;
  uint32_t moved_ = 0;    // bits of the objects that moved since the last tick
  uint32_t renewed_ = 0;  // bits of the objects whose bound was taken anew where the proxy was
  Feature met_[2];        // of the last of them
  ProxyMoved renewals_;   // steps and work
  Bounds base_;           // where the proxy begins its move
  // The query of the proxy that is being answered.
  ObjectQuery query_;
  Place at_;
  query::Budget budget_;
  float needed_m_ = 0;
  float key_m_[kMaxObjects];  // bounds at that place
  uint32_t exact_ = 0;        // bits of those that are not taken over from base_
  uint32_t answered_ = 0;
  bool is_short_ = false;  // the work ran out
  Near nearest_;
};

/// The nearest of several objects, as one shape that a proxy touches.
template <class Shapes>
struct NearestObject {
  ObjectsTick& tick;
  Shapes& shapes;

  Near near(math::Vec3 x_m, query::Budget budget, float needed_m) {
    tick.begin_query(x_m, budget, needed_m);
    while (tick.next()) {
      const ObjectQuery& q = tick.query();
      tick.take(shapes.near(q.object, q.x_m, q.budget, q.needed_m));
    }
    return tick.nearest();
  }
  // The least of all objects that are in reach.
  template <class S = Shapes>
  auto free_part(const Way& way, query::Budget budget, uint32_t& work) const
      -> decltype(static_cast<S&>(shapes).free_part(0u, way, budget, work)) {
    float least = budget.work < kMinObjectsWay ? 0.0f : 1.0f;
    Way own;
    for (uint32_t i = 0; i < tick.count() && least > 0.0f; ++i) {
      if (!tick.is_in_reach(i, way, own)) continue;
      const float part = shapes.free_part(i, own, {budget.work - work}, work);
      if (part < least) least = part;
    }
    return least;
  }
  float size_m() const { return shapes.size_m(); }
};

/// Contact of a sphere with several objects, as touch_by_proxy() with one. Friction is the larger
/// of that in `contact` and of the object that is touched; their stiffnesses are in series. A far
/// object, or one without stiffness, costs a comparison. Objects that leave the proxy less than 0.9
/// of its radius squeeze it: model.is_squeezed, which servo makes a fault. The proxy crosses none
/// of them.
/// Bounds: scene/proxy.hpp, and at most one query an object to carry the proxy; all share the
/// budget. Re-entrant for different tools.
template <class Shapes>
void touch_objects(const ProxyContact& contact, const ObjectSet& set, Shapes& shapes,
                   ObjectsTouch& touch, servo::LocalModel& model) {
  ObjectsTick tick(contact, set, shapes.size_m(), touch);
  while (tick.carry()) {
    const ObjectQuery& q = tick.query();
    tick.take_bound(shapes.near(q.object, q.x_m, q.budget, q.needed_m));
  }
  NearestObject<Shapes> nearest{tick, shapes};
  tick.finish(move_proxy(tick.settings(), tick.goal_m(), nearest, touch.touch.proxy), model);
}

}  // namespace firmtouch::scene
