#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"
#include "firmtouch/servo/local_model.hpp"

// What every effect does to a local model, the library's and a user's own alike: an effect is a
// free function that looks at the tool and adds to the model. A user composes his tick from the
// effects that he wants; nothing is registered.
//
//     scene::begin_model(model, position_m, tick, age_ticks);
//     scene::touch_mesh(object, tool_radius_m, position_m, budget, touch, model);
//     my_wall(position_m, model);            // his own shape: add_contact() inside
//     my_spring_to_home(position_m, model);  // his own effect: add_plane(), add_guide()
namespace firmtouch::scene {

/// How a surface or a guide answers.
struct Material {
  float stiffness_N_per_m = 0;
  float damping_N_s_per_m = 0;
};

/// What a shape says about the tool's centre: how far its surface is, which way is out, and what is
/// certain of it.
struct SurfacePoint {
  float distance_m = 0;  // signed: negative inside
  math::Vec3 normal;     // unit, outward, device frame
  int8_t sign = 0;       // +1, -1; 0 = unknown: no plane is made
  float lower_m = 0;     // certified: no point of the surface is nearer
};

/// An empty model about `position_m` (device frame), one sequence number on, that lives for
/// `age_ticks` after `tick`.
void begin_model(servo::LocalModel& model, math::Vec3 position_m, uint32_t tick,
                 uint32_t age_ticks);

/// Result: false, and the model as it was, where kMaxPlanes are in it.
bool add_plane(servo::LocalModel& model, const servo::ContactPlane& plane);

/// The guide of the model.
/// Result: false, and the model as it was, where it has one: two guides at once cannot be felt.
bool add_guide(servo::LocalModel& model, const servo::GuideLine& guide);

/// Penalty contact of a sphere about `position_m` with a shape: a plane tangent to it, moved out by
/// the radius. The model's free radius shrinks to what the shape leaves.
/// Of more than kMaxPlanes contacts the deepest are kept.
/// Result: how deep the sphere reaches in, 0 where it is free. No plane, and 0, where the sign is
/// unknown, the normal is not a unit vector, or the model is full of deeper ones.
float add_contact(servo::LocalModel& model, math::Vec3 position_m, float radius_m,
                  const SurfacePoint& surface, const Material& material);

}  // namespace firmtouch::scene
