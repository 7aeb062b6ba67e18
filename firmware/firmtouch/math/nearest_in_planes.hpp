#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"

// The projection of a point on the intersection of half-spaces, and how far friction lets a point
// slide towards it. Positions are relative to a feasible point, the origin: differences of
// coordinates keep their last digits there.
namespace firmtouch::math {

constexpr uint32_t kMaxHalfSpaces = 8;

/// dot(normal, x) >= offset_m. Pre: the normal is unit to 1e-5.
struct HalfSpace {
  Vec3 normal;
  float offset_m = 0;
};

/// The half-spaces whose planes hold a point.
struct ActivePlanes {
  uint8_t plane[3] = {};
  uint8_t count = 0;
};

struct NearestInPlanes {
  Vec3 point_m;
  ActivePlanes active;
  // The planes agree to 1e-5 |goal|. If false, point_m is where the search ended.
  bool is_found = false;
};

/// The point nearest to `goal_m` with all of `planes`, with at most three of them active. From the
/// optimum of some planes the dual method goes to that of them and of the plane that is violated
/// most, and lets go of planes that would pull, until none is violated. `before`: the active planes
/// of a like problem, in any state; if all of them push here, it begins with them.
/// Bounds: at most 12 planes join, each after at most 3 that are let go; at most 9,500 instructions
///         for 7 planes, of which a search found 9,000.
/// Result: finite where all input is finite and below 1e6 m. Planes beyond kMaxHalfSpaces are
///         ignored, and so are those with NaN. No plane: the goal. A goal with NaN: the origin.
/// Error: 5e-7 |goal|, where three planes meet at small angles 1e-5; planes that agree in direction
///         to 1e-5 rad count as one.
/// Source: Goldfarb & Idnani 1983, A numerically stable dual method for solving strictly convex
///         quadratic programs.
NearestInPlanes nearest_in_planes(const HalfSpace* planes, uint32_t count, Vec3 goal_m,
                                  ActivePlanes before = {});

struct Slide {
  Vec3 point_m;
  bool is_stuck = false;  // friction holds the point
};

/// What holds a slide back. Lengths are stretches of the spring that pulls.
struct Friction {
  float coulomb = 0;  // pull along the planes over pull across them
  // Viscous friction, implicit in time: of the way beyond Coulomb friction, with what was slid
  // already in this step, this part remains. Pre: 0 to 1. It is c / (c + K T), where c is the
  // viscous friction, K the stiffness of the spring and T the time of the step.
  float viscous_share = 0;
  float slid_m = 0;
};

/// Where friction lets a point at the origin come to rest that is pulled to `nearest`: it slides
/// along the active planes until friction bears the pull along them. Never farther from the goal
/// than the origin is, except for rounding.
/// Pre: `nearest` is nearest_in_planes() of the same planes and goal.
Slide slide_with_friction(const HalfSpace* planes, uint32_t count, Vec3 goal_m,
                          const NearestInPlanes& nearest, const Friction& friction);

}  // namespace firmtouch::math
