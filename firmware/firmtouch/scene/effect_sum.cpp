#include "firmtouch/scene/effect_sum.hpp"

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/compose.hpp"

namespace firmtouch::scene {
namespace {

using math::Vec3;

constexpr float kMaxForce_N = 1e6f;  // its powers do not overflow
constexpr float kMaxPotential_J = 1e6f;
constexpr float kRegain_J = 1e-6f;  // a tick: 1 mW at 1 kHz, far below what a hand feels

bool is_between(float value, float low, float high) { return value >= low && value <= high; }

}  // namespace

EffectSum::EffectSum(float limit_N, Vec3 contact_N) {
  if (!is_between(limit_N, 0.0f, servo::kMaxDriveLimit_N)) return;
  if (!math::is_within(contact_N, kMaxForce_N)) return;
  contact_N_ = contact_N;
  const float own_N = math::length(contact_N);
  limit_N_ = own_N > limit_N ? own_N : limit_N;
}

// Where the ray from the sum along the force leaves the ball of the limit.
float EffectSum::room_for(Vec3 force_N) const {
  const Vec3 sum_N = contact_N_ + effects_N_;
  const float square = math::dot(force_N, force_N), along = math::dot(sum_N, force_N);
  const float left = limit_N_ * limit_N_ - math::dot(sum_N, sum_N);
  const float room = left > 0.0f ? left : 0.0f;
  const float root = math::square_root(along * along + square * room);
  // Of the two forms of the solution the one without cancellation.
  const float share = along > 0.0f ? room / (along + root) : (root - along) / square;
  return share < 1.0f ? share : 1.0f;
}

float EffectSum::add(Vec3 force_N) {
  if (!math::is_within(force_N, kMaxForce_N) || !(math::dot(force_N, force_N) > 0.0f)) return 0.0f;
  const float share = room_for(force_N);
  effects_N_ = effects_N_ + force_N * share;
  return share;
}

float EffectSum::add(Vec3 direction, float size_N) { return add(direction * size_N); }

// With the share s, the potential U and the stored energy a <= U, the work that a way takes from
// the hand is s dU. It is added to a, and s <= a / U. So a, which is never negative, pays all that
// the force gives.
float EffectSum::add(const EffectForce& effect, EffectStore& store) {
  const float potential_J = effect.potential_J;
  if (!is_between(potential_J, 0.0f, kMaxPotential_J) ||
      !math::is_within(effect.force_N, kMaxForce_N)) {
    store.share = 0;
    return 0.0f;
  }
  float stored_J = potential_J;
  if (store.is_used) {
    stored_J = store.stored_J + store.share * (potential_J - store.potential_J) + kRegain_J;
    if (!(stored_J >= 0.0f)) stored_J = 0.0f;
    if (stored_J > potential_J) stored_J = potential_J;
  }
  const float paid = potential_J > 0.0f ? stored_J / potential_J : 1.0f;
  float share = 1.0f;
  if (math::dot(effect.force_N, effect.force_N) > 0.0f) {
    share = room_for(effect.force_N);
    if (paid < share) share = paid;
    effects_N_ = effects_N_ + effect.force_N * share;
  }
  store = {stored_J, potential_J, share, true};
  return share;
}

bool EffectSum::put(Vec3 position_m, servo::LocalModel& model) const {
  model.has_guide = false;
  const float size_N = math::length(effects_N_);
  if (!(size_N >= 1e-12f) || !math::is_within(position_m, servo::kMaxPosition_m)) return false;
  servo::GuideLine line;
  line.point_m = position_m;
  line.direction = effects_N_ * (1.0f / size_N);
  line.drive_N = size_N;
  line.drive_limit_N = size_N < servo::kMaxDriveLimit_N ? size_N : servo::kMaxDriveLimit_N;
  return add_guide(model, line);
}

}  // namespace firmtouch::scene
