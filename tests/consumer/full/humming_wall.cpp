#include "humming_wall.hpp"

#include "firmtouch/scene/compose.hpp"

void add_hum(firmtouch::servo::LocalModel& model, const HummingWall& wall, float radius_m,
             uint32_t tick) {
  firmtouch::servo::ContactPlane plane;
  plane.normal = {0, 0, 1};
  plane.offset_m = wall.height_m + radius_m + (tick % 8 < 4 ? wall.amplitude_m : -wall.amplitude_m);
  plane.stiffness_N_per_m = wall.stiffness_N_per_m;
  firmtouch::scene::add_plane(model, plane);
}
