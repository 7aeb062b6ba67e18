#pragma once
#include <stdint.h>

#include "firmtouch/math/nearest_in_planes.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/query/certificate.hpp"
#include "firmtouch/scene/touched.hpp"

// The proxy: the centre of the tool's sphere as it would be if the sphere could not enter the part.
// A spring ties it to the hand. scene/README.md has the algorithm and its theorems.
namespace firmtouch::scene {

constexpr uint32_t kMaxFeatures = 7;  // of the working set: a (tool, object) pair fits 512 B
constexpr uint32_t kMaxQueries = 4;   // a tick
constexpr uint32_t kWayShare = 8;     // an eighth of the work that is left may search a way
// Relative to the size of the shape.
constexpr float kClearance = 2e-6f;  // that a place may lack of the radius
constexpr float kMinRadius = 4e-6f;  // of a tool that is a point: what the clearance needs
// The share of its radius below which objects that move squeeze a tool.
constexpr float kSqueezed = 0.9f;
// On a shape that proves no way free (free_part() in scene/touched.hpp) a move ends with the free
// ball, so a smaller one would lag behind a hand.
constexpr float kMinBall = 1e-3f;
// A length times this is rounded up.
constexpr float kLengthUp = 1.0f + 8.0f * 0x1p-24f;

struct ProxySettings {
  float radius_m = 0;
  float friction_static = 0;
  float friction_dynamic = 0;
  // The slide a tick at which friction is 37 % of the way from dynamic to static, and the part of a
  // tick in the mean of slides.
  float friction_slide_m = 1e-6f;
  float viscous_share = 0;  // see math::Friction
  float slide_share = 0.125f;
  float growth_m = 0;    // a tick, of the radius of a tool that began too near to a surface
  query::Budget budget;  // work of all queries of a tick together
};

/// State of a (tool, object) pair from tick to tick. The caller owns one a pair. A default one
/// begins a contact: see `phase`.
struct Proxy {
  enum class Phase : uint8_t {
    kUnknown,  // not yet certified anywhere
    kInside,   // the tool began inside: it is led out
    kFree,     // certified: the theorems hold from here on
  };
  math::Vec3 position_m;    // device frame
  float free_m = 0;         // certified: no surface nearer to position_m
  float radius_m = 0;       // in use; reaches the setting's when there is room for it
  float slid_m = 0;         // a tick, mean of the last ones
  bool is_growing = false;  // it began too near to a surface for its radius
  bool is_loaded = false;   // the last tick ended with the hand elsewhere
  Phase phase = Phase::kUnknown;
  Nearness near;  // at the last query that certified it
  // While the side of the hand is unknown: a place of the hand and the free ball about it, in which
  // a search for the side began that has come to position_m.
  math::Vec3 searched_m;
  float searched_free_m = 0;
  Feature feature[kMaxFeatures];
  // Each has its feature behind it, wherever it was taken; only those that hold the proxy are taken
  // anew. Their offsets count from planes_at_m.
  math::HalfSpace plane[kMaxFeatures];
  math::Vec3 planes_at_m;
  math::ActivePlanes active;  // in the last solution
  uint32_t feature_count = 0;
  float bend_per_m = 0;  // radians that the surface turned by along the last way: bend()
};

/// Relative to the size of the shape: features that differ by less are the same.
constexpr float kSameFeature = 1e-6f;
/// Index in the working set; feature_count: none is the same.
uint32_t index_of(const Feature& feature, const Proxy& proxy, float size_m);

/// Bounds of the distance between shape and proxy, or hand where there is no proxy; without sign.
struct Bounds {
  float lower_m, upper_m;
};
Bounds bounds_of(const Proxy& proxy, math::Vec3 hand_m);

/// What a tick of a proxy has done.
struct ProxyMoved {
  uint32_t steps = 0;
  uint32_t work = 0;  // units
  uint8_t queries = 0;
  bool is_optimal = false;  // ended at the solution for the working set
  bool is_starved = false;  // the visits ran out: contact is uncertain
  bool is_of_base_hull = false;
};

/// One tick, driven by the caller, who makes the queries:
///
///     ProxyMove move(settings, size_m, goal_m, proxy);
///     while (move.aim()) move.take(nearest_of(shape, move));
///     const ProxyMoved moved = move.finish();
///
/// which move_proxy() does. Bounds: at most kMaxQueries queries, which share the budget, and beside
/// them at most 60,000 instructions; searches over 400,000 ticks of a part found up to 51,000.
/// Usual are 2,500 for each.
class ProxyMove {
 public:
  ProxyMove(const ProxySettings& settings, float size_m, math::Vec3 goal_m, Proxy& proxy);

  /// Result: whether a query is needed to go on.
  bool aim();
  math::Vec3 query_m() const { return trial_m_; }
  query::Budget budget() const;
  float needed_m() const;
  /// Whether the query is short of where the proxy would go, for its free ball ends: then it is
  /// made where the free part of way() ends.
  bool is_short() const { return is_short_; }
  Way way() const;
  query::Budget way_budget() const { return {work_left_ / kWayShare}; }
  void take_way(float free_part, uint32_t work);
  /// Makes the way longer on a surface that bends away from its plane: to where the slide would
  /// end.
  void bend();
  /// Measures the bend by the normal that the query at query_m() found.
  void take_bend(math::Vec3 outward);
  void take(const Near& near);
  ProxyMoved finish();

 private:
  math::Vec3 along_face(math::Vec3 way_m) const;
  void use_radius();
  void begin_contact(const Near& near);
  void begin_at(math::Vec3 place_m, int8_t sign);
  void drop_base_hull();
  void drop(uint32_t i);
  void begin_planes();
  void take_plane(uint32_t i);
  bool take_active();
  void take_all();
  math::Slide rest();
  bool is_longer(math::Vec3 to_m) const;
  bool drift();
  bool keep(const Feature& feature);
  bool is_within_certified(math::Vec3 to_m, float& left_m) const;

  const ProxySettings& settings_;
  Proxy& proxy_;
  math::Vec3 goal_m_, trial_m_, begin_m_;
  math::Vec3 along_m_;  // the way that it would go
  float size_m_;
  math::Friction friction_;
  float free_way_m_ = 0;      // to the hand, of a proxy without load: the band reaches as far
  float aimed_radius_m_ = 0;  // the radius that is grown to in this tick
  float cap_;                 // part of the free radius that a move may take
  bool is_over_ = false, is_short_ = false;
  uint8_t again_left_ = 5;     // solutions of a tick because planes were taken elsewhere
  bool is_searching_ = false;  // for the side of the hand, from where another tick has come
  bool is_beside_ = false;     // the hand is on the surface: it begins beside it
  uint32_t work_left_;
  Outlook outlook_;
  uint32_t taken_ = 0;  // bits of the planes that were taken where the proxy is
  float lag_m_ = 0;     // from there to the solution
  // Of the face that alone holds the proxy; cosine to `outward` of the last query, 0: none does.
  math::Vec3 face_normal_;
  float face_cosine_ = 0;
  float bend_per_m_ = 0;  // by the last query
  ProxyMoved moved_;
};

/// The query that a move needs next, farther on if the shape proves the way there free. The second
/// one is for shapes without free_part().
template <class Shape>
auto nearest_of(Shape& shape, ProxyMove& move, int)
    -> decltype(shape.free_part(move.way(), move.way_budget(), *static_cast<uint32_t*>(nullptr)),
                Near()) {
  if (move.is_short()) {
    uint32_t work = 0;
    const float free_part = shape.free_part(move.way(), move.way_budget(), work);
    move.take_way(free_part, work);
  }
  return shape.near(move.query_m(), move.budget(), move.needed_m());
}
template <class Shape>
Near nearest_of(Shape& shape, ProxyMove& move, long) {
  move.bend();
  const Near near = shape.near(move.query_m(), move.budget(), move.needed_m());
  move.take_bend(near.outward);
  return near;
}
template <class Shape>
Near nearest_of(Shape& shape, ProxyMove& move) {
  return nearest_of(shape, move, 0);
}

/// The settings with a radius of at least kMinBall.
ProxySettings with_ball(const ProxySettings& settings, float size_m);
/// Those for a shape; the second one is for shapes with free_part().
template <class Shape>
ProxySettings settings_for(Shape& shape, const ProxySettings& settings, long) {
  return with_ball(settings, shape.size_m());
}
template <class Shape>
auto settings_for(Shape& shape, const ProxySettings& settings, int)
    -> decltype(shape.free_part(Way{}, query::Budget{}, *static_cast<uint32_t*>(nullptr)),
                (settings)) {
  return settings;
}

/// Moves the proxy towards the hand at `goal_m` (device frame).
/// Result, from the first tick with Phase::kFree on, for every shape whose bounds are true, every
///         budget, goal, setting, and content of the working set:
///   no crossing: the proxy's path meets no surface;
///   clearance: it ends at a place certified proxy.radius_m - 2e-6 size away from all of it;
///   energy: with friction it is never farther from the hand than where it began; without, at most
///     by 1e-7 of the size.
template <class Shape>
ProxyMoved move_proxy(const ProxySettings& settings, math::Vec3 goal_m, Shape& shape,
                      Proxy& proxy) {
  const ProxySettings& used = settings_for(shape, settings, 0);
  ProxyMove move(used, shape.size_m(), goal_m, proxy);
  while (move.aim()) move.take(nearest_of(shape, move));
  return move.finish();
}

}  // namespace firmtouch::scene
