#include "firmtouch/math/nearest_in_planes.hpp"

#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::math {
namespace {

// Relative to the goal's distance: a point that is outside of a plane by less is accepted.
constexpr float kTolerance = 1e-5f;
// Squared sine of the least angle between planes that are solved together.
constexpr float kMinSine2 = 1e-10f;

// Orthogonal directions in which up to three planes are reached one after the other.
struct Basis {
  Vec3 normal[3];     // of the planes
  Vec3 direction[3];  // of which each is perpendicular to the normals before
  float size2[3];     // of the directions
  float share[3][3];  // share[k][i]: of direction i in normal k
  uint32_t count = 0;

  // Result: false, nothing added, if the normal depends on those before.
  bool add(Vec3 n) {
    Vec3 d = n;
    for (uint32_t i = 0; i < count; ++i) {
      share[count][i] = dot(n, direction[i]) / size2[i];
      d = d - direction[i] * share[count][i];
    }
    // Once more: what is left of a small difference is not yet perpendicular.
    for (uint32_t i = 0; i < count; ++i) d = d - direction[i] * (dot(d, direction[i]) / size2[i]);
    const float d2 = dot(d, d);
    if (!(d2 > kMinSine2)) return false;
    normal[count] = n;
    direction[count] = d;
    size2[count] = d2;
    ++count;
    return true;
  }
};

struct Trial {
  Vec3 point_m;
  bool is_pushed = true;  // no plane pulls: all multipliers are at least 0
};

// Projects `from_m` on the planes of the basis.
Trial project(const Basis& basis, const float (&offset_m)[3], Vec3 from_m) {
  Trial trial;
  trial.point_m = from_m;
  float along[3] = {};
  for (uint32_t k = 0; k < basis.count; ++k) {
    along[k] = (offset_m[k] - dot(basis.normal[k], trial.point_m)) / basis.size2[k];
    trial.point_m = trial.point_m + basis.direction[k] * along[k];
  }
  // From coefficients of the directions to multipliers of the normals, the last first.
  for (uint32_t k = basis.count; k-- > 0;) {
    if (!(along[k] >= 0.0f)) trial.is_pushed = false;
    for (uint32_t i = 0; i < k; ++i) along[i] -= basis.share[k][i] * along[k];
  }
  return trial;
}

class Search {
 public:
  Search(const HalfSpace* planes, uint32_t count, Vec3 goal_m) : goal_m_(goal_m) {
    for (uint32_t i = 0; i < count && i < kMaxHalfSpaces; ++i) {
      const HalfSpace& plane = planes[i];
      if (!is_finite(plane.normal) || !is_finite(plane.offset_m)) continue;
      plane_[count_] = plane;
      number_[count_++] = i;
    }
    tolerance_m_ = kTolerance * length(goal_m);
  }

  NearestInPlanes run() {
    if (try_subset(0, 0, 0, 0)) return best_;
    for (uint32_t size = 1; size <= 3; ++size) {
      for (uint32_t i = 0; i + size <= count_; ++i) {
        if (size == 1 ? try_subset(1, i, 0, 0) : with_others(size, i)) return best_;
      }
    }
    return best_;
  }

 private:
  bool with_others(uint32_t size, uint32_t i) {
    for (uint32_t j = i + 1; j < count_; ++j) {
      if (size == 2 && try_subset(2, i, j, 0)) return true;
      for (uint32_t k = j + 1; size == 3 && k < count_; ++k)
        if (try_subset(3, i, j, k)) return true;
    }
    return false;
  }

  // How far a point is outside of the worst plane.
  float violation_m(Vec3 point_m) const {
    float worst_m = 0.0f;
    for (uint32_t i = 0; i < count_; ++i) {
      const float out_m = plane_[i].offset_m - dot(plane_[i].normal, point_m);
      if (out_m > worst_m) worst_m = out_m;
    }
    return worst_m;
  }

  // Result: whether this subset solves the problem.
  bool try_subset(uint32_t size, uint32_t i, uint32_t j, uint32_t k) {
    const uint32_t at[3] = {i, j, k};
    Basis basis;
    float offset_m[3] = {};
    for (uint32_t n = 0; n < size; ++n) {
      offset_m[n] = plane_[at[n]].offset_m;
      if (!basis.add(plane_[at[n]].normal)) return false;
    }
    const Trial trial = project(basis, offset_m, goal_m_);
    if (!trial.is_pushed) return false;
    const float worst_m = violation_m(trial.point_m);
    const bool is_found = worst_m <= (size == 0 ? 0.0f : tolerance_m_);
    if (!is_found && !(worst_m < best_violation_m_)) return false;
    best_violation_m_ = worst_m;
    best_.point_m = trial.point_m;
    best_.active_count = size;
    for (uint32_t n = 0; n < size; ++n) best_.active[n] = number_[at[n]];
    best_.is_found = is_found;
    return is_found;
  }

  HalfSpace plane_[kMaxHalfSpaces];
  uint32_t number_[kMaxHalfSpaces] = {};
  uint32_t count_ = 0;
  Vec3 goal_m_;
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

NearestInPlanes nearest_in_planes(const HalfSpace* planes, uint32_t count, Vec3 goal_m) {
  if (!is_finite(goal_m)) return {};
  return Search(planes, count, goal_m).run();
}

Slide slide_with_friction(const HalfSpace* planes, uint32_t count, Vec3 goal_m,
                          const NearestInPlanes& nearest, float friction) {
  const Vec3 end_m = nearest.point_m;
  if (!(friction > 0.0f) || nearest.active_count == 0) return {end_m, false};
  Basis basis;
  float offset_m[3] = {};
  for (uint32_t n = 0; n < nearest.active_count; ++n) {
    const HalfSpace& plane = planes[nearest.active[n]];
    if (basis.add(plane.normal)) offset_m[basis.count - 1] = plane.offset_m;
  }
  // Slides begin where the origin is pressed on the planes.
  const Vec3 begin_m = project(basis, offset_m, {}).point_m;
  const float held_m = friction * length(goal_m - end_m);
  const float way_m = length(begin_m - end_m);
  if (way_m <= held_m) {
    if (is_allowed(planes, count, begin_m, kTolerance * length(goal_m))) return {begin_m, true};
  } else {
    const Vec3 stop_m = end_m + (begin_m - end_m) * (held_m / way_m);
    if (is_allowed(planes, count, stop_m, kTolerance * length(goal_m))) return {stop_m, false};
  }
  // Another plane is in that way: straight from the origin, which is allowed as both its ends are.
  const float straight_m = length(end_m);
  if (straight_m <= held_m) return {{}, true};
  return {end_m * (1.0f - held_m / straight_m), false};
}

}  // namespace firmtouch::math
