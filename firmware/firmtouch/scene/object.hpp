#pragma once
#include <float.h>
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"

namespace firmtouch::scene {

/// Motion of an object, device frame: of the origin of its own frame, and about it.
struct Twist {
  math::Vec3 velocity_mps;
  math::Vec3 turn_rad_per_s;
};

/// What a tool may touch, beside its shape: where it is, how it moves, how it feels.
struct Object {
  math::RigidTransform pose;  // own frame -> device frame
  Twist twist;
  float stiffness_N_per_m = FLT_MAX;  // of its material, in series with the tool's; 0: air
  float friction_static = 0;
  float friction_dynamic = 0;
};

// Beyond these an object is refused: no scene that a hand reaches needs more.
constexpr float kMaxObjectDistance_m = 10.0f;
constexpr float kMaxObjectSpeed_mps = 100.0f;
constexpr float kMaxObjectTurn_rad_per_s = 1000.0f;
constexpr float kMaxFriction = 100.0f;

/// Why an object is refused.
enum class ObjectProblem : uint8_t {
  kNone,
  kNotARotation,  // rows that are no unit vectors across each other to 1e-4, or a mirror image
  kTooFarAway,    // kMaxObjectDistance_m
  kTooFast,       // kMaxObjectSpeed_mps, kMaxObjectTurn_rad_per_s
  kMaterial,      // a stiffness or friction that is negative, a friction beyond kMaxFriction
};

/// What is wrong and what to do, in one line.
const char* text_of(ObjectProblem problem);

/// Sets `object`, its rotation made orthonormal. NaN is refused by what it stands in.
/// Result: kNone; else why not, and `object` is unchanged except that it stands still.
ObjectProblem set_object(const Object& wanted, Object& object);

/// A turn by |turn_rad| about turn_rad.
math::Mat3 rotation_by(math::Vec3 turn_rad);

/// Moves an object by its twist for `passed_s`. One that would leave kMaxObjectDistance_m stops.
/// Bounds: about 310 instructions for one that turns; re-entrant.
/// Error: a rotation stays orthonormal to 4e-7 for any number of calls.
void advance(Object& object, float passed_s);

}  // namespace firmtouch::scene
