#pragma once
#include <stddef.h>
#include <stdint.h>

// Byte layout of the tool of an asset (tools/FORMAT.md, section 3g). Little-endian.
namespace firmtouch::scene {

constexpr uint32_t kToolSection = 0x8002;
constexpr uint32_t kMaxSpheres = 8;
constexpr float kMaxArm_m = 1.0f;  // of a sphere's centre from the handle, an axis
constexpr float kMaxSphereRadius_m = 0.1f;

/// A sphere that is fixed to the handle.
struct SphereLayout {
  float at_m[3];  // of its centre, handle's frame
  float radius_m;
};
static_assert(sizeof(SphereLayout) == 16 && offsetof(SphereLayout, radius_m) == 12);

/// Why opening rejects; the numbers never change. tools/FORMAT.md prints the same text.
enum ToolRule : uint16_t {
  // The section holds no whole number of spheres, or none, or more than 8.
  kRuleSphereCount = 831,
  // The centre of a sphere is more than 1 m from the handle, in an axis.
  kRuleSpherePlace = 832,
  // The radius of a sphere is not 0 to 0.1 m.
  kRuleSphereRadius = 833,
  // The asset has a tool and objects or materials of triangles: a tool touches one mesh of one
  // material.
  kRuleToolAlone = 834,
};

}  // namespace firmtouch::scene
