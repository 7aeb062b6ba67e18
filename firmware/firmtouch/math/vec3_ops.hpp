#pragma once
// Arithmetic on Vec3 for the library's own translation units, with internal linkage, so that every
// unit computes with the flags that the library was built with. The order of operations is part of
// the result: do not rearrange.

#include "firmtouch/math/isa.hpp"
#include "firmtouch/math/vec3.hpp"

namespace firmtouch::math {

static inline Vec3 operator+(Vec3 a, Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
static inline Vec3 operator-(Vec3 a, Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
static inline Vec3 operator-(Vec3 a) { return {-a.x, -a.y, -a.z}; }
static inline Vec3 operator*(Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
static inline Vec3 operator*(float s, Vec3 a) { return {a.x * s, a.y * s, a.z * s}; }
static inline float dot(Vec3 a, Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static inline Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline float length(Vec3 a) { return square_root(dot(a, a)); }
/// Whether its length is 1 to a hundredth; false with NaN.
static inline bool is_about_unit(Vec3 a) {
  const float square = dot(a, a);
  return square >= 0.98f && square <= 1.02f;
}

static inline Vec3 operator*(const Mat3& m, Vec3 v) {
  return {dot(m.row[0], v), dot(m.row[1], v), dot(m.row[2], v)};
}
static inline Vec3 transposed_times(const Mat3& m, Vec3 v) {
  return m.row[0] * v.x + m.row[1] * v.y + m.row[2] * v.z;
}
[[gnu::always_inline]] static inline Vec3 turn(const RigidTransform& t, const Vec3& v) {
  return t.rotation * v;
}
[[gnu::always_inline]] static inline Vec3 turn_back(const RigidTransform& t, const Vec3& v) {
  return transposed_times(t.rotation, v);
}
[[gnu::always_inline]] static inline const Vec3& turn(const Translation&, const Vec3& v) {
  return v;
}
[[gnu::always_inline]] static inline const Vec3& turn_back(const Translation&, const Vec3& v) {
  return v;
}
static inline Vec3 apply(const RigidTransform& t, Vec3 point_m) {
  return t.rotation * point_m + t.translation_m;
}
static inline Vec3 apply_inverse(const RigidTransform& t, Vec3 point_m) {
  return transposed_times(t.rotation, point_m - t.translation_m);
}
[[gnu::always_inline]] static inline Vec3 apply(const Translation& t, const Vec3& point_m) {
  return point_m + t.translation_m;
}
[[gnu::always_inline]] static inline Vec3 apply_inverse(const Translation& t, const Vec3& point_m) {
  return point_m - t.translation_m;
}

/// True where all three are finite: the comparison fails on NaN.
static inline bool is_finite(float a) { return a - a <= 0.0f; }
static inline bool is_finite(Vec3 a) { return (a.x - a.x) + (a.y - a.y) + (a.z - a.z) <= 0.0f; }

/// True where |a| <= most, in each axis: on the bits, whose order is that of the sizes. NaN fails.
static inline bool is_within(float a, float most) {
  return (bits_of(a) & 0x7FFFFFFFu) <= bits_of(most);
}
static inline bool is_within(Vec3 a, float most) {
  return is_within(a.x, most) && is_within(a.y, most) && is_within(a.z, most);
}
/// True where 0 <= a <= most, on the bits. NaN fails; -0 is 0.
static inline bool is_up_to(float a, float most) {
  return bits_of(a) <= bits_of(most) || bits_of(a) == 0x80000000u;
}

}  // namespace firmtouch::math
