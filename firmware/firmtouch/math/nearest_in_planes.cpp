#include "firmtouch/math/nearest_in_planes.hpp"

#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::math {
namespace {

// Relative to the goal's distance: a point that is outside of a plane by less is accepted.
constexpr float kTolerance = 1e-5f;
// Squared sine of the least angle between planes that are solved together.
constexpr float kMinSine2 = 1e-10f;

// Planes that are reached one after the other, each in a direction perpendicular to the normals
// before. A subset of planes begins with a shorter one: only its last plane costs anew.
class Reach {
 public:
  explicit Reach(Vec3 from_m) { point_m_[0] = from_m; }

  /// The point of all planes so far that is nearest to the beginning.
  Vec3 point_m() const { return point_m_[count_]; }
  uint32_t count() const { return count_; }
  void drop_to(uint32_t count) { count_ = count; }

  /// Whether the plane, as the last, would push: its multiplier is at least 0.
  bool would_push(const HalfSpace& plane) const { return lacking_m(plane) >= 0.0f; }

  /// Result: false, nothing added, if the normal depends on those before.
  bool add(const HalfSpace& plane) {
    Vec3 d = plane.normal;
    for (uint32_t i = 0; i < count_; ++i) {
      share_[count_][i] = dot(plane.normal, direction_[i]) / size2_[i];
      d = d - direction_[i] * share_[count_][i];
    }
    // Once more: what is left of a small difference is not yet perpendicular.
    for (uint32_t i = 0; i < count_; ++i)
      d = d - direction_[i] * (dot(d, direction_[i]) / size2_[i]);
    const float d2 = dot(d, d);
    if (!(d2 > kMinSine2)) return false;
    direction_[count_] = d;
    size2_[count_] = d2;
    along_[count_] = lacking_m(plane) / d2;
    point_m_[count_ + 1] = point_m_[count_] + d * along_[count_];
    ++count_;
    return true;
  }

  /// Whether no plane pulls: all multipliers are at least 0.
  bool is_pushed() const {
    float along[3] = {along_[0], along_[1], along_[2]};
    // From coefficients of the directions to multipliers of the normals, the last first.
    for (uint32_t k = count_; k-- > 0;) {
      if (!(along[k] >= 0.0f)) return false;
      for (uint32_t i = 0; i < k; ++i) along[i] -= share_[k][i] * along[k];
    }
    return true;
  }

 private:
  float lacking_m(const HalfSpace& plane) const {
    return plane.offset_m - dot(plane.normal, point_m());
  }

  // A vector that is not cleared: to clear all of these takes as long as a plane.
  struct Bare {
    float x, y, z;
    operator Vec3() const { return {x, y, z}; }
    Bare& operator=(Vec3 v) {
      x = v.x, y = v.y, z = v.z;
      return *this;
    }
  };

  Bare point_m_[4];
  Bare direction_[3];
  float size2_[3];
  float share_[3][3];  // share_[k][i]: of direction i in normal k
  float along_[3];     // coefficients of the directions
  uint32_t count_ = 0;
};

bool is_finite(const HalfSpace& plane) {
  const float sum = (plane.normal.x + plane.normal.y) + (plane.normal.z + plane.offset_m);
  return sum - sum <= 0.0f;
}

bool is_outside_any(const HalfSpace* planes, uint32_t count, Vec3 point_m, float tolerance_m) {
  for (uint32_t i = 0; i < count; ++i)
    if (planes[i].offset_m - dot(planes[i].normal, point_m) > tolerance_m) return true;
  return false;
}

// Whether these planes alone hold the answer, which is unique. Pre: `reach` has no plane.
bool is_held_by(const ActivePlanes& active, const HalfSpace* planes, uint32_t count, Vec3 goal_m,
                Reach& reach, NearestInPlanes& found) {
  if (active.count > 3) return false;
  if (active.count == 0) {
    found = {goal_m, active, true};
    return !is_outside_any(planes, count, goal_m, 0.0f);
  }
  for (uint32_t n = 0; n < active.count; ++n) {
    const uint32_t i = active.plane[n];
    if (i >= count || !is_finite(planes[i]) || !reach.add(planes[i])) return false;
  }
  if (!reach.is_pushed()) return false;
  if (is_outside_any(planes, count, reach.point_m(), kTolerance * length(goal_m))) return false;
  found = {reach.point_m(), active, true};
  return true;
}

// The optimum of the planes that were violated so far, one more at a time.
class Search {
 public:
  Search(const HalfSpace* planes, uint32_t count, Vec3 goal_m, Reach& reach)
      : planes_(planes), reach_(reach) {
    for (uint32_t i = 0; i < count && i < kMaxHalfSpaces; ++i)
      if (is_finite(planes[i])) order_[count_++] = i;
    best_.point_m = goal_m;
    tolerance_m_ = kTolerance * length(goal_m);
  }

  NearestInPlanes run() {
    // The goal itself is only the answer if it violates nothing.
    float least_m = 0.0f;
    for (uint32_t known = 0; known <= count_; ++known) {
      if (!find_violated(known, least_m)) {
        best_.is_found = true;
        return best_;
      }
      least_m = tolerance_m_;
      if (known == count_ || !solve(known)) return best_;
    }
    return best_;
  }

 private:
  const HalfSpace& plane_at(uint32_t place) const { return planes_[order_[place]]; }

  // Moves the plane that is violated most to place `known`. Result: false if none is by more than
  // `least_m`.
  bool find_violated(uint32_t known, float least_m) {
    uint32_t at = count_;
    for (uint32_t i = known; i < count_; ++i) {
      const float out_m = violation_m(i, best_.point_m);
      if (out_m > least_m) least_m = out_m, at = i;
    }
    if (at == count_) return false;
    const uint32_t plane = order_[at];
    order_[at] = order_[known];
    order_[known] = plane;
    return true;
  }

  // The optimum of the planes up to `last`, which is violated by that of the planes before it: so
  // it is active. Result: false if there is none; the best subset is kept.
  bool solve(uint32_t last) {
    best_violation_m_ = FLT_MAX;
    if (!choose(last, 0, 3)) return false;  // it need not push alone
    if (try_subset(last)) return true;
    for (uint32_t size = 2; size <= 3; ++size) {
      for (uint32_t i = 0; i < last; ++i) {
        if (!choose(i, 1, size)) continue;
        if (size == 2 && try_subset(last)) return true;
        for (uint32_t j = i + 1; size == 3 && j < last; ++j)
          if (choose(j, 2, size) && try_subset(last)) return true;
      }
    }
    return false;
  }

  // Result: false if no subset of `size` that begins with `before` planes and this one can push.
  bool choose(uint32_t plane, uint32_t before, uint32_t size) {
    reach_.drop_to(before);
    chosen_[before] = plane;
    if (before + 1 == size && !reach_.would_push(plane_at(plane))) return false;
    return reach_.add(plane_at(plane));
  }

  float violation_m(uint32_t plane, Vec3 point_m) const {
    return plane_at(plane).offset_m - dot(plane_at(plane).normal, point_m);
  }

  // Result: whether the chosen planes solve the problem of the planes up to `last`.
  bool try_subset(uint32_t last) {
    if (!reach_.is_pushed()) return false;
    float worst_m = 0.0f;
    for (uint32_t i = 0; i <= last; ++i) {
      const float out_m = violation_m(i, reach_.point_m());
      if (out_m > worst_m) worst_m = out_m;
    }
    if (!(worst_m < best_violation_m_)) return false;
    best_violation_m_ = worst_m;
    best_.point_m = reach_.point_m();
    best_.active.count = static_cast<uint8_t>(reach_.count());
    for (uint32_t n = 0; n < reach_.count(); ++n)
      best_.active.plane[n] = static_cast<uint8_t>(order_[chosen_[n]]);
    return worst_m <= tolerance_m_;
  }

  const HalfSpace* planes_;
  uint32_t order_[kMaxHalfSpaces];
  uint32_t count_ = 0;
  Reach& reach_;
  uint32_t chosen_[3];
  float tolerance_m_ = 0;
  float best_violation_m_ = FLT_MAX;
  NearestInPlanes best_;
};

bool is_allowed(const HalfSpace* planes, uint32_t count, Vec3 point_m, float tolerance_m) {
  for (uint32_t i = 0; i < count; ++i) {
    const float low_m = planes[i].offset_m < 0.0f ? planes[i].offset_m : 0.0f;
    if (!(dot(planes[i].normal, point_m) >= low_m - tolerance_m)) return false;
  }
  return true;
}

}  // namespace

NearestInPlanes nearest_in_planes(const HalfSpace* planes, uint32_t count, Vec3 goal_m,
                                  ActivePlanes before) {
  if (!is_finite(goal_m)) return {};
  NearestInPlanes found;
  const uint32_t known = count < kMaxHalfSpaces ? count : kMaxHalfSpaces;
  Reach reach(goal_m);
  if (is_held_by(before, planes, known, goal_m, reach, found)) return found;
  return Search(planes, count, goal_m, reach).run();
}

Slide slide_with_friction(const HalfSpace* planes, uint32_t count, Vec3 goal_m,
                          const NearestInPlanes& nearest, const Friction& friction) {
  const Vec3 end_m = nearest.point_m;
  const float coulomb = friction.coulomb > 0.0f ? friction.coulomb : 0.0f;
  if (!(coulomb > 0.0f || friction.viscous_share > 0.0f) || nearest.active.count == 0)
    return {end_m, false};
  const float held_m = coulomb * length(goal_m - end_m);
  const auto left_m = [&](float way_m) {
    return held_m + (way_m - held_m + friction.slid_m) * friction.viscous_share;
  };
  Reach reach(Vec3{});
  for (uint32_t n = 0; n < nearest.active.count; ++n) reach.add(planes[nearest.active.plane[n]]);
  // Slides begin where the origin is pressed on the planes.
  const Vec3 begin_m = reach.point_m();
  const float way_m = length(begin_m - end_m);
  const float stop_m = left_m(way_m);
  const bool is_stuck = !(stop_m < way_m);
  const Vec3 rest_m = is_stuck ? begin_m : end_m + (begin_m - end_m) * (stop_m / way_m);
  if (is_allowed(planes, count, rest_m, kTolerance * length(goal_m))) return {rest_m, is_stuck};
  // Another plane is in that way: straight from the origin, which is allowed as both its ends are.
  const float straight_m = length(end_m);
  const float held_back_m = left_m(straight_m);
  if (!(held_back_m < straight_m)) return {{}, true};
  return {end_m * (1.0f - held_back_m / straight_m), false};
}

}  // namespace firmtouch::math
