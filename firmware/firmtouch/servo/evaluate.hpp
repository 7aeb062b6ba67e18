#pragma once
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/servo/local_model.hpp"

namespace firmtouch::servo {

/// Whether every number of the model is finite and in range and its directions are unit to 1 %.
bool is_sound(const LocalModel& model);

/// Force of the model on the tool at this position and velocity (device frame). A plane pushes
/// along its normal or not at all, so its damper never pulls the tool into the surface. Planes add
/// up. The guide acts across its line beyond its tunnel, without a jump at the wall, and along it
/// by its drive.
/// Pre: is_sound(model), position and velocity finite and within the limits of local_model.hpp.
/// Result: finite.
math::Vec3 evaluate(const LocalModel& model, math::Vec3 position_m, math::Vec3 velocity_mps);

/// The part of the planes alone.
math::Vec3 planes_N(const LocalModel& model, math::Vec3 position_m, math::Vec3 velocity_mps);

}  // namespace firmtouch::servo
