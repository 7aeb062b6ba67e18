#pragma once
#include "firmtouch/scene/compose.hpp"

/// A shape of this project: a torus about the z axis through `centre_m`, in closed form.
struct Torus {
  firmtouch::math::Vec3 centre_m;
  float ring_radius_m;
  float tube_radius_m;
};

firmtouch::scene::SurfacePoint closest_on(const Torus& torus, firmtouch::math::Vec3 position_m);
