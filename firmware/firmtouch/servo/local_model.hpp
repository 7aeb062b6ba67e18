#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"

namespace firmtouch::servo {

constexpr uint32_t kMaxPlanes = 3;  // a corner of three faces

// Limits of a local model: far beyond every device, and small enough that no sum of its forces
// overflows.
constexpr float kMaxStiffness_N_per_m = 1e6f;
constexpr float kMaxDamping_N_s_per_m = 1e4f;
constexpr float kMaxPosition_m = 1e4f;
constexpr float kMaxVelocity_mps = 1e4f;
constexpr float kMaxDrive_N = 1e9f;  // before drive_limit_N
constexpr float kMaxDriveLimit_N = 1e3f;
constexpr float kMaxTunnel_m = 1e3f;

/// Free where dot(normal, x) >= offset_m (device frame); behind it a spring and damper along the
/// normal.
struct ContactPlane {
  math::Vec3 normal;  // unit, outward
  float offset_m = 0;
  float stiffness_N_per_m = 0;
  float damping_N_s_per_m = 0;
};

/// A spring from the tool to the proxy, which stays in front of all surfaces. Scene certifies where
/// the proxy may be, servo moves it. Device frame.
struct ProxySpring {
  math::Vec3 anchor_m;  // a certified place
  float reach_m = 0;    // so far from the anchor the tool's sphere meets no surface either
  float stiffness_N_per_m = 0;
  float damping_N_s_per_m = 0;
  bool is_used = false;
  bool is_held = false;     // a surface holds the proxy at the anchor
  math::Vec3 velocity_mps;  // of the object that carries the proxy
};

/// A straight piece of a guide: pulls toward the line, across it only. Along it the tool is free,
/// or driven.
struct GuideLine {
  math::Vec3 point_m;
  math::Vec3 direction;  // unit
  math::Vec3 edge;       // unit: pulls this way alone, and the other side is free; zero: all around
  float stiffness_N_per_m = 0;
  float damping_N_s_per_m = 0;
  float tunnel_m = 0;  // nearer to the line than this there is no force across it
  // Along the line: drive_N at the point and at rest, less spring and damper.
  float drive_N = 0;
  float drive_stiffness_N_per_m = 0;
  float drive_damping_N_s_per_m = 0;
  float drive_limit_N = 0;  // largest force along the line, either way; 0: free
};

/// What scene passes to servo: not a force, but planes and a line, so that servo can evaluate the
/// force at the fresh position, at its own rate. Device frame.
struct LocalModel {
  ContactPlane plane[kMaxPlanes];
  uint32_t plane_count = 0;
  ProxySpring spring;
  GuideLine guide;
  bool has_guide = false;
  bool is_uncertain = false;  // the budget did not suffice to know where the surfaces are
  bool is_squeezed = false;   // objects leave the proxy no room
  math::Vec3 made_at_m;
  uint32_t sequence = 0;
  uint32_t made_tick = 0;     // another one for each model
  uint32_t expires_tick = 0;  // after it the model is stale, and the force is ramped down
};

}  // namespace firmtouch::servo
