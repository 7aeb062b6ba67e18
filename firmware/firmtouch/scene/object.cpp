#include "firmtouch/scene/object.hpp"

#include "firmtouch/math/sine_cosine.hpp"
#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::scene {
namespace {

using math::Mat3;
using math::Vec3;

constexpr float kOrthonormal = 1e-4f;

bool is_between(float value, float low, float high) { return value >= low && value <= high; }

bool is_one(float value) { return is_between(value, 1.0f - kOrthonormal, 1.0f + kOrthonormal); }

bool is_rotation(const Mat3& m) {
  for (uint32_t i = 0; i < 3; ++i) {
    const Vec3 row = m.row[i], next = m.row[(i + 1) % 3];
    if (!is_one(math::dot(row, row))) return false;
    if (!is_between(math::dot(row, next), -kOrthonormal, kOrthonormal)) return false;
  }
  return math::dot(math::cross(m.row[0], m.row[1]), m.row[2]) > 0.0f;
}

// Pre: nearly a rotation. Bitwise the identity stays the identity.
Mat3 orthonormal(const Mat3& m) {
  const Vec3 x = m.row[0] * (1.0f / math::length(m.row[0]));
  const Vec3 aside = m.row[1] - x * math::dot(x, m.row[1]);
  const Vec3 y = aside * (1.0f / math::length(aside));
  return {{x, y, math::cross(x, y)}};
}

bool is_friction(float value) { return is_between(value, 0.0f, kMaxFriction); }

}  // namespace

// The matrix of the unit quaternion (w, v).
Mat3 rotation_by(Vec3 turn_rad) {
  const float angle_rad = math::length(turn_rad);
  if (!(angle_rad > 0.0f)) return {};
  const math::SineCosine half = math::sine_cosine(0.5f * angle_rad);
  const Vec3 v = turn_rad * (half.sine / angle_rad);
  const float w = half.cosine, xx = v.x * v.x, yy = v.y * v.y, zz = v.z * v.z;
  return {{{1 - 2 * (yy + zz), 2 * (v.x * v.y - w * v.z), 2 * (v.x * v.z + w * v.y)},
           {2 * (v.x * v.y + w * v.z), 1 - 2 * (xx + zz), 2 * (v.y * v.z - w * v.x)},
           {2 * (v.x * v.z - w * v.y), 2 * (v.y * v.z + w * v.x), 1 - 2 * (xx + yy)}}};
}

const char* text_of(ObjectProblem problem) {
  switch (problem) {
    case ObjectProblem::kNone:
      return "no problem";
    case ObjectProblem::kNotARotation:
      return "the pose's matrix is no rotation: its rows must be unit vectors across each other";
    case ObjectProblem::kTooFarAway:
      return "the object is more than 10 m from the origin: use metres, and a nearer origin";
    case ObjectProblem::kTooFast:
      return "the twist exceeds 100 m/s or 1,000 rad/s: use metres and radians a second";
    case ObjectProblem::kMaterial:
      return "a stiffness or friction is negative, or a friction beyond 100";
  }
  return "unknown";
}

ObjectProblem set_object(const Object& wanted, Object& object) {
  object.twist = {};
  if (!is_rotation(wanted.pose.rotation)) return ObjectProblem::kNotARotation;
  if (!math::is_within(wanted.pose.translation_m, kMaxObjectDistance_m))
    return ObjectProblem::kTooFarAway;
  if (!math::is_within(wanted.twist.velocity_mps, kMaxObjectSpeed_mps) ||
      !math::is_within(wanted.twist.turn_rad_per_s, kMaxObjectTurn_rad_per_s))
    return ObjectProblem::kTooFast;
  if (!is_between(wanted.stiffness_N_per_m, 0.0f, FLT_MAX) ||
      !is_friction(wanted.friction_static) || !is_friction(wanted.friction_dynamic))
    return ObjectProblem::kMaterial;
  object = wanted;
  object.pose.rotation = orthonormal(wanted.pose.rotation);
  return ObjectProblem::kNone;
}

void advance(Object& object, float passed_s) {
  const Twist twist = object.twist;
  if (math::dot(twist.turn_rad_per_s, twist.turn_rad_per_s) > 0.0f) {
    const Mat3 turn = rotation_by(twist.turn_rad_per_s * passed_s);
    const Mat3 was = object.pose.rotation;
    Mat3 now;
    for (uint32_t i = 0; i < 3; ++i) now.row[i] = math::transposed_times(was, turn.row[i]);
    object.pose.rotation = orthonormal(now);
  }
  const Vec3 to_m = object.pose.translation_m + twist.velocity_mps * passed_s;
  if (math::is_within(to_m, kMaxObjectDistance_m))
    object.pose.translation_m = to_m;
  else
    object.twist = {};
}

}  // namespace firmtouch::scene
