#pragma once
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/scene/effects.hpp"
#include "firmtouch/servo/local_model.hpp"

// Several effects at once, beside contact and a guide, within one limit of force.
//
//     scene::EffectSum sum(force_limit_N, servo::contact_N(model, position_m, velocity_mps));
//     sum.add(servo::guide_N(model, position_m, velocity_mps));       // before what matters less
//     sum.add(scene::detents_at(detents, position_m), detents_store);
//     sum.add(scene::viscous_N(viscosity, velocity_mps));
//     sum.put(position_m, model);
namespace firmtouch::scene {

/// Energy of an effect that stores it, from tick to tick. The caller owns one an effect.
struct EffectStore {
  float stored_J = 0;
  float potential_J = 0;  // at the last tick's place
  float share = 0;        // of its force, in the last tick
  bool is_used = false;
};

/// Sum in the order of the calls, which is that of priority. Contact is first: the effects never
/// reduce what servo renders of it, except where all of it together reaches the slew limit. Each
/// effect gets the largest share, 0 to 1, that leaves the sum within the limit. The shares are
/// continuous in all forces.
/// Bounds: about 70 instructions to begin, 140 instructions an effect, 130 instructions to put.
/// Error: the sum exceeds the limit by at most 1e-6 of it.
class EffectSum {
 public:
  /// `limit_N`: 0 to servo::kMaxDriveLimit_N. `contact_N` beyond it leaves room for what does not
  /// make the sum longer. With NaN, or a limit out of range, no effect gets a share.
  EffectSum(float limit_N, math::Vec3 contact_N);

  /// A damper, or a driven force. A damper stays one under any share.
  /// Result: the share; 0 for NaN.
  float add(math::Vec3 force_N);

  /// A force along a unit vector, such as vibration_N(): negative against it.
  float add(math::Vec3 direction, float size_N);

  /// A force of a potential. A share that changes would give energy on closed loops: it also is at
  /// most what the hand has paid, stored_J over potential_J. Then the share gives in n ticks at
  /// most the potential of the first one and n 1e-6 J, by which a share that fell rises again. Not
  /// counted: that a force is held for a tick. As any spring it gives no energy by that up to a
  /// stiffness of twice the damping of device and hand over the tick's period; of detents it is 2
  /// pi times the limit over the pitch. One call each tick; a new store where the effect was left
  /// out.
  float add(const EffectForce& effect, EffectStore& store);

  /// Sum of the effects.
  math::Vec3 force_N() const { return effects_N_; }

  /// Puts the sum in the model, instead of its guide. At two rates it acts until the next model.
  /// Result: false, and the model without a guide, if the sum is 0 or the position not sound.
  bool put(math::Vec3 position_m, servo::LocalModel& model) const;

 private:
  float room_for(math::Vec3 force_N) const;

  math::Vec3 contact_N_, effects_N_;
  float limit_N_ = 0;
};

}  // namespace firmtouch::scene
