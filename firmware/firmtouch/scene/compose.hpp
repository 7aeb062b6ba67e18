#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"
#include "firmtouch/servo/local_model.hpp"

// How effects, the library's and a user's own alike, fill a local model: an effect is a free
// function that reads the tool's position and adds to the model. A user calls the effects of a tick
// one after the other; nothing is registered.
//
//     scene::begin_model(model, position_m, tick, age_ticks);
//     scene::touch_mesh(object, tool_radius_m, position_m, budget, touch, model);
//     my_wall(position_m, model);            // your own shape: calls add_contact()
//     my_spring_to_home(position_m, model);  // your own effect: calls add_plane() or add_guide()
namespace firmtouch::scene {

/// Spring and damper of a surface or a guide.
struct Material {
  float stiffness_N_per_m = 0;
  float damping_N_s_per_m = 0;
};

/// Closest point of a shape to the tool's centre.
struct SurfacePoint {
  float distance_m = 0;  // signed: negative inside
  math::Vec3 normal;     // unit, outward, device frame
  int8_t sign = 0;       // +1, -1; 0 = unknown: no plane is made
};

/// Empties the model. It is about `position_m` (device frame), has the next sequence number, and
/// expires `age_ticks` after `tick`.
void begin_model(servo::LocalModel& model, math::Vec3 position_m, uint32_t tick,
                 uint32_t age_ticks);

/// Result: false, and the model unchanged, if it has kMaxPlanes.
bool add_plane(servo::LocalModel& model, const servo::ContactPlane& plane);

/// Result: false, and the model unchanged, if it has a guide: two at once cannot be distinguished
/// by touch.
bool add_guide(servo::LocalModel& model, const servo::GuideLine& guide);

/// Penalty contact of a sphere about `position_m` with a shape: a plane tangent to the shape, moved
/// out by the radius. The model's free radius shrinks to the shape's `lower_m`. Of more than
/// kMaxPlanes contacts the deepest are kept.
/// Result: the penetration, 0 in free space. No plane, and 0, if the sign is unknown, the normal is
/// not a unit vector, or the model is full of deeper contacts.
float add_contact(servo::LocalModel& model, math::Vec3 position_m, float radius_m,
                  const SurfacePoint& surface, const Material& material);

}  // namespace firmtouch::scene
