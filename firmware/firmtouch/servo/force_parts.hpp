#pragma once
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/servo/local_model.hpp"

// evaluate() by parts, for effects that share the limit of force with contact and a guide
// (scene/effect_sum.hpp).
namespace firmtouch::servo {

/// Force of the planes and of the proxy's spring, however long it is (device frame).
/// Pre: as evaluate(). Result: finite.
/// Bounds: about 430 instructions.
math::Vec3 contact_N(const LocalModel& model, math::Vec3 position_m, math::Vec3 velocity_mps);

/// Force of the guide; 0 without one.
/// Pre: as evaluate(). Result: finite.
/// Bounds: about 290 instructions.
math::Vec3 guide_N(const LocalModel& model, math::Vec3 position_m, math::Vec3 velocity_mps);

}  // namespace firmtouch::servo
