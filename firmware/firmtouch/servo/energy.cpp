#include "firmtouch/servo/energy.hpp"

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::servo {

float payable_stretch_m(Energy& energy, float& left_J, const EnergySettings& settings,
                        float stiffness_N_per_m, float stretch_m, math::Vec3 move_m,
                        math::Vec3 before_m, float object_J) {
  const float lost_J = math::larger(settings.friction_N_per_m * math::dot(move_m, before_m), 0.0f);
  const float given_J = math::dot(energy.force_N, move_m) - object_J - lost_J;
  const float stored_J = 0.5f * stiffness_N_per_m * stretch_m * stretch_m;
  float available_J = energy.saved_J + left_J - given_J;
  const float most_J = stored_J + settings.reservoir_J;
  if (!(available_J <= most_J)) available_J = most_J;
  const float entered_m = stretch_m - energy.stretch_m;
  const float grown_m = energy.payable_m + entered_m;
  const float paid_J = math::larger(available_J, 0.0f);
  left_J = math::smaller(math::larger(available_J - stored_J, left_J), paid_J);
  energy.saved_J = available_J - left_J;
  energy.stretch_m = stretch_m;
  energy.payable_m = stretch_m;
  const bool is_giving = given_J > 0.0f, is_out = !(stretch_m > 0.0f) && is_giving;
  energy.is_unpaid = (entered_m < 0.0f || is_out) && given_J > available_J;
  if (!(available_J < -kOverdraft_J))
    energy.overdrawn_ticks = 0;
  else if (energy.overdrawn_ticks < UINT16_MAX)
    ++energy.overdrawn_ticks;

  // What a tool that leaves faster and faster, or is about to turn, takes by the next tick. Within
  // an encoder's step nothing is predicted.
  const bool is_moving = entered_m < 0.0f || entered_m > 0.0f;
  const float faster_m = entered_m < energy.entered_m ? energy.entered_m - entered_m : 0.0f;
  const float left_m = is_moving ? faster_m - entered_m : 0.0f;
  energy.entered_m = entered_m;
  const float friction_N = settings.friction_N_per_m * left_m;
  const float next_J = (stiffness_N_per_m * stretch_m - friction_N) * left_m;
  const bool is_paid = available_J >= stored_J && available_J >= next_J;
  if (is_paid || !(stiffness_N_per_m > 0.0f)) return stretch_m;
  float payable_m = math::square_root(2.0f * paid_J / stiffness_N_per_m);
  if (left_m > 0.0f) {
    const float next_m = (paid_J / left_m + friction_N) / stiffness_N_per_m;
    if (next_m < payable_m) payable_m = next_m;
  } else if (!is_giving && payable_m < grown_m) {
    payable_m = grown_m;
  }
  if (!(payable_m < stretch_m)) return stretch_m;
  energy.payable_m = payable_m;
  energy.is_unpaid = true;
  return payable_m;
}

}  // namespace firmtouch::servo
