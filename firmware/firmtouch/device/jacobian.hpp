#pragma once
#include "firmtouch/math/vec3_ops.hpp"

// The condition of two columns in a plane and of three in space. For .cpp files of this module
// alone; linkage.hpp says what it is.
namespace firmtouch::device {

// Below it a Jacobian in float32 has no digits left.
constexpr float kSingular = 1e-4f;

struct Planar {
  float x, y;
};
static inline Planar operator+(Planar a, Planar b) { return {a.x + b.x, a.y + b.y}; }
static inline Planar operator-(Planar a, Planar b) { return {a.x - b.x, a.y - b.y}; }
static inline Planar operator*(Planar a, float s) { return {a.x * s, a.y * s}; }
static inline float dot(Planar a, Planar b) { return a.x * b.x + a.y * b.y; }
static inline float cross(Planar a, Planar b) { return a.x * b.y - a.y * b.x; }

/// Of parts that are not negative: at most 1, and 0 for NaN.
static inline float unit_ratio(float part, float whole) {
  const float ratio = part / whole;
  if (ratio <= 1.0f) return ratio;
  return ratio > 1.0f ? 1.0f : 0.0f;
}

static inline float condition_of(Planar a, Planar b) {
  return unit_ratio(2.0f * __builtin_fabsf(cross(a, b)), dot(a, a) + dot(b, b));
}

static inline float condition_of(math::Vec3 a, math::Vec3 b, math::Vec3 c) {
  const math::Vec3 ab = math::cross(a, b), bc = math::cross(b, c), ca = math::cross(c, a);
  const float columns = math::dot(a, a) + math::dot(b, b) + math::dot(c, c);
  const float adjugate = math::dot(ab, ab) + math::dot(bc, bc) + math::dot(ca, ca);
  return unit_ratio(3.0f * __builtin_fabsf(math::dot(ab, c)),
                    math::square_root(columns * adjugate));
}

}  // namespace firmtouch::device
