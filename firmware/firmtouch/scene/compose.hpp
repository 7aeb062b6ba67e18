#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"
#include "firmtouch/servo/local_model.hpp"

// Effects add to a local model. An effect is a free function that reads the tool's position and
// adds planes or a guide; a tick is a sequence of such calls, the library's and your own. Nothing
// is registered.
//
//     scene::begin_model(model, position_m, tick, age_ticks);
//     scene::touch_mesh(object, tool_radius_m, position_m, budget, touch, model);
//     my_wall(position_m, model);            // your own shape: add_contact() inside
//     my_spring_to_home(position_m, model);  // your own effect: add_plane(), add_guide()
namespace firmtouch::scene {

/// Spring and damper of a surface or a guide.
struct Material {
  float stiffness_N_per_m = 0;
  float damping_N_s_per_m = 0;
};

/// What a shape reports about the tool's centre: signed distance, outward normal, and what of it is
/// certain.
struct SurfacePoint {
  float distance_m = 0;  // signed: negative inside
  math::Vec3 normal;     // unit, outward, device frame
  int8_t sign = 0;       // +1, -1; 0 = unknown: no plane is made
  float lower_m = 0;     // certified: no point of the surface is nearer
};

/// Makes an empty model about `position_m` (device frame), with the next sequence number, that
/// expires `age_ticks` after `tick`.
void begin_model(servo::LocalModel& model, math::Vec3 position_m, uint32_t tick,
                 uint32_t age_ticks);

/// Adds a contact plane.
/// Result: false and no change if the model has kMaxPlanes already.
bool add_plane(servo::LocalModel& model, const servo::ContactPlane& plane);

/// Sets the guide of the model.
/// Result: false and no change if the model has one: it holds a single guide.
bool add_guide(servo::LocalModel& model, const servo::GuideLine& guide);

/// Adds penalty contact of a sphere about `position_m` with a shape: the tangent plane, moved
/// outward by the radius. Shrinks the model's free radius to the shape's lower bound. Of more than
/// kMaxPlanes contacts the deepest are kept.
/// Result: penetration depth, 0 in free space. No plane and 0 if the sign is unknown, the normal is
/// not a unit vector, or the model is full of deeper contacts.
float add_contact(servo::LocalModel& model, math::Vec3 position_m, float radius_m,
                  const SurfacePoint& surface, const Material& material);

}  // namespace firmtouch::scene
