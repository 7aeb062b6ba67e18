#pragma once
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/servo/local_model.hpp"

namespace firmtouch::servo {

/// The tool's offset, as far as the guide acts on it: from the line, or from the edge; zero on its
/// free side. Device frame.
math::Vec3 guided_off_m(const GuideLine& guide, math::Vec3 position_m);

/// How far such an offset stretches the spring: its length beyond the tunnel.
float stretch_m(const GuideLine& guide, math::Vec3 off_m);

/// Spring and damper at such an offset, across the line, or along the edge's normal, which neither
/// ever pulls the tool against. Within a tunnel there is none; beyond it both grow without a jump.
/// `share`: of the spring.
/// Pre: as evaluate(). Result: finite.
math::Vec3 pull_N(const GuideLine& guide, math::Vec3 off_m, math::Vec3 velocity_mps, float share);

/// Force of the drive, along the line.
/// Pre: as evaluate(). Result: finite.
math::Vec3 drive_N(const GuideLine& guide, math::Vec3 position_m, math::Vec3 velocity_mps);

}  // namespace firmtouch::servo
