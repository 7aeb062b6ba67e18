#include "firmtouch/math/nearest_in_planes.hpp"

#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::math {
namespace {

// Relative to the goal's distance: a point that is outside of a plane by less is accepted.
constexpr float kTolerance = 0x1p-21f;
constexpr float kLoosely = 20.0f;  // so many times that, where rounding leaves planes no better
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
    if (count_ == 3 || !(d2 > kMinSine2)) return false;
    direction_[count_] = d;
    size2_[count_] = d2;
    along_[count_] = lacking_m(plane) / d2;
    point_m_[count_ + 1] = point_m_[count_] + d * along_[count_];
    ++count_;
    return true;
  }

  /// How strongly each plane pushes: goal and point differ by the sum of these times the normals.
  void find_pushes(float (&push)[3]) const {
    for (uint32_t k = 0; k < count_; ++k) push[k] = along_[k];
    to_normals(push);
  }

  /// What of each normal adds up to that of `plane`, which add() has refused.
  void find_parts(float (&part)[3]) const {
    for (uint32_t k = 0; k < count_; ++k) part[k] = share_[count_][k];
    to_normals(part);
  }

 private:
  // From coefficients of the directions to those of the normals, the last first.
  void to_normals(float (&of)[3]) const {
    for (uint32_t k = count_; k-- > 1;)
      for (uint32_t i = 0; i < k; ++i) of[i] -= share_[k][i] * of[k];
  }

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
  float share_[4][3];  // share_[k][i]: of direction i in normal k
  float along_[3];     // coefficients of the directions
  uint32_t count_ = 0;
};

// A dual method: from the optimum of some planes to that of them and of the one that it violates
// most, until none is violated. On the way there planes that would pull are let go.
class Search {
 public:
  Search(const HalfSpace* planes, uint32_t count, Vec3 goal_m)
      : planes_(planes),
        count_(count < kMaxHalfSpaces ? count : kMaxHalfSpaces),
        tolerance_m_(kTolerance * length(goal_m)),
        reach_(goal_m) {}

  /// Begins with the optimum of these planes, if all of them push.
  void begin(const ActivePlanes& before) {
    if (before.count > 3) return;
    for (; active_.count < before.count; ++active_.count) {
      const uint8_t i = before.plane[active_.count];
      if (i >= count_ || !is_finite(planes_[i]) || !reach_.add(planes_[i])) return forget();
      active_.plane[active_.count] = i;
    }
    reach_.find_pushes(push_);
    for (uint32_t n = 0; n < active_.count; ++n)
      if (!(push_[n] >= 0.0f)) return forget();
  }

  NearestInPlanes run() {
    // The goal itself is only the answer if it violates nothing.
    float least_m = active_.count == 0 ? 0.0f : tolerance_m_;
    bool is_last = false;
    for (uint32_t step = 0;; ++step) {
      uint8_t violated = 0;
      const bool is_found = !find_violated(least_m, violated);
      if (is_found || is_last) return {reach_.point_m(), active_, is_found};
      is_last = step == kMaxSteps || !add(violated);
      least_m = is_last ? kLoosely * tolerance_m_ : tolerance_m_;
    }
  }

 private:
  // Each optimum is farther from the goal than the one before, except for rounding.
  static constexpr uint32_t kMaxSteps = 12;

  static bool is_finite(const HalfSpace& plane) {
    const float sum = (plane.normal.x + plane.normal.y) + (plane.normal.z + plane.offset_m);
    return sum - sum <= 0.0f;
  }

  void forget() {
    active_.count = 0;
    reach_.drop_to(0);
  }

  // The plane that is violated most. Result: false if none is by more than `least_m`.
  bool find_violated(float least_m, uint8_t& violated) const {
    const Vec3 point_m = reach_.point_m();
    bool is_any = false;
    for (uint32_t i = 0; i < count_; ++i) {
      const float out_m = planes_[i].offset_m - dot(planes_[i].normal, point_m);
      if (out_m > least_m && is_finite(planes_[i]))
        least_m = out_m, violated = static_cast<uint8_t>(i), is_any = true;
    }
    return is_any;
  }

  // Result: false if the planes have no point in common.
  bool add(uint8_t plane) {
    for (;;) {
      const uint32_t before = active_.count;
      const bool is_added = reach_.add(planes_[plane]);
      float change[3];  // of the pushes before, on the whole way or for a push of 1
      if (is_added)
        reach_.find_pushes(change);
      else
        reach_.find_parts(change);
      for (uint32_t n = 0; n < before; ++n)
        // NOLINTNEXTLINE(clang-analyzer-core*): `reach_` holds as many planes as `active_`
        change[n] = is_added ? change[n] - push_[n] : -change[n];
      // The first push that ends.
      float way = is_added ? 1.0f : FLT_MAX;
      uint32_t first = before;
      for (uint32_t n = 0; n < before; ++n)
        if (push_[n] + way * change[n] < 0.0f) way = push_[n] / -change[n], first = n;
      if (first == before) {
        if (!is_added) return false;
        active_.plane[active_.count++] = plane;
        for (uint32_t n = 0; n < before; ++n) push_[n] += change[n];
        push_[before] = change[before];  // NOLINT(clang-analyzer-core*): added above
        return true;
      }
      for (uint32_t n = 0; n < before; ++n) push_[n] += way * change[n];
      if (!let_go(first)) return false;
    }
  }

  // Result: false if what is left depends on each other, by rounding.
  bool let_go(uint32_t first) {
    --active_.count;
    for (uint32_t n = first; n < active_.count; ++n) {
      active_.plane[n] = active_.plane[n + 1];
      push_[n] = push_[n + 1];
    }
    reach_.drop_to(first);
    for (uint32_t n = first; n < active_.count; ++n)
      if (!reach_.add(planes_[active_.plane[n]])) return false;
    return true;
  }

  const HalfSpace* planes_;
  uint32_t count_;
  float tolerance_m_;
  Reach reach_;
  ActivePlanes active_;  // those of reach_
  float push_[3];
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
  if (!math::is_finite(goal_m)) return {};
  Search search(planes, count, goal_m);
  search.begin(before);
  return search.run();
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
  const float rounding_m = 4.0f * kTolerance * length(goal_m);  // of two points and their mix
  if (is_allowed(planes, count, rest_m, rounding_m)) return {rest_m, is_stuck};
  // Another plane is in that way: straight from the origin, which is allowed as both its ends are.
  const float straight_m = length(end_m);
  const float held_back_m = left_m(straight_m);
  if (!(held_back_m < straight_m)) return {{}, true};
  return {end_m * (1.0f - held_back_m / straight_m), false};
}

}  // namespace firmtouch::math
