#include "target/answers.hpp"

#include "firmtouch/core/hash.hpp"
#include "firmtouch/curve/closest_point.hpp"
#include "firmtouch/mesh/closest_point.hpp"

namespace firmtouch::target {
namespace {

constexpr float kNever = __builtin_nanf("");
constexpr uint32_t kBudgets[] = {UINT32_MAX, UINT32_MAX, UINT32_MAX, 64, 16, 4, 1};

void add(core::Hash& hash, float value) {
  uint32_t bits;
  __builtin_memcpy(&bits, &value, sizeof bits);
  hash.add(bits);
}

void add(core::Hash& hash, math::Vec3 v) {
  add(hash, v.x);
  add(hash, v.y);
  add(hash, v.z);
}

void add(core::Hash& hash, const query::Certificate& certificate) {
  add(hash, certificate.lower_m);
  hash.add(certificate.steps);
  hash.add((certificate.exact ? 1u : 0u) | static_cast<uint32_t>(certificate.sign + 1) << 1);
}

/// Points about a box. Only sums and products by themselves: nothing that a compiler could
/// contract.
class Points {
 public:
  Points(const float (&low_m)[3], const float (&high_m)[3]) {
    for (int k = 0; k < 3; ++k) {
      low_m_[k] = low_m[k];
      extent_m_[k] = high_m[k] - low_m[k];
      at_[k] = 0.5f;
    }
  }

  math::Vec3 next(uint32_t i) {
    if (i % 997 == 996) return hostile(i / 997);
    const bool scattered = i % 4 == 3;
    float unit[3];
    for (int k = 0; k < 3; ++k) {
      const float r = random();
      if (scattered) {
        const float stretched = r * 4.0f;
        unit[k] = stretched - 1.5f;
      } else {
        const float moved = (r - 0.5f) * 0.015625f;
        at_[k] += moved;
        if (at_[k] > 1.0f || at_[k] < 0.0f) at_[k] = r;
        unit[k] = at_[k];
      }
    }
    return {place(0, unit[0]), place(1, unit[1]), place(2, unit[2])};
  }

 private:
  float random() {  // 0 to 1, from the upper bits of a linear congruence (Numerical Recipes, 7.1.2)
    state_ = state_ * 1664525u + 1013904223u;
    return static_cast<float>(state_ >> 8) * 0x1p-24f;
  }
  float place(int axis, float unit) const {
    const volatile float part_m =
        extent_m_[axis] * unit;  // volatile: rounded before it is added, on every target
    return low_m_[axis] + part_m;
  }
  static math::Vec3 hostile(uint32_t which) {
    switch (which % 5) {
      case 0:
        return {kNever, 0, 0};
      case 1:
        return {0, __builtin_inff(), 0};
      case 2:
        return {3e38f, -3e38f, 3e38f};
      case 3:
        return {1e-42f, -1e-42f, 0};
      default:
        return {1e12f, 0, -1e12f};
    }
  }

  float low_m_[3], extent_m_[3], at_[3];
  uint32_t state_ = 20240229;
};

void add_mesh_answers(core::Hash& hash, const mesh::View& mesh, uint32_t count) {
  Points points(mesh.head().low_m, mesh.head().high_m);
  const float band_m = mesh.head().diagonal_m * 0.0078125f;
  mesh::Hint hint;
  for (uint32_t i = 0; i < count; ++i) {
    if (i % 16 == 0) hint = {};
    query::Budget budget{kBudgets[i % 7]};
    if (i % 3 == 1) budget.band_m = band_m;
    const mesh::Closest c = mesh::closest_point(mesh, points.next(i), budget, hint);
    add(hash, c.distance_m);
    add(hash, c.point_m);
    add(hash, c.direction);
    hash.add(c.triangle);
    hash.add(static_cast<uint32_t>(c.feature));
    add(hash, c.certificate);
  }
}

void add_curve_answers(core::Hash& hash, const curve::View& curve, uint32_t count) {
  Points points(curve.head().low_m, curve.head().high_m);
  curve::Hint hint;
  for (uint32_t i = 0; i < count; ++i) {
    if (i % 16 == 0) hint = {};
    const query::Budget budget{kBudgets[i % 7]};
    const curve::Closest c = curve::closest_point(curve, points.next(i), budget, hint);
    add(hash, c.distance_m);
    add(hash, c.point_m);
    add(hash, c.tangent);
    hash.add(c.segment);
    add(hash, c.arc);
    add(hash, c.certificate);
  }
}

}  // namespace

uint64_t hash_answers(const Views& views, uint32_t count) {
  core::Hash hash;
  const uint32_t curve_count = views.curve.is_open() ? count / 3 : 0;
  if (views.mesh.is_open()) add_mesh_answers(hash, views.mesh, count - curve_count);
  if (views.curve.is_open()) add_curve_answers(hash, views.curve, curve_count);
  return hash.value();
}

}  // namespace firmtouch::target
