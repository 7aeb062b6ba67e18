#pragma once
#include <stddef.h>
#include <stdint.h>

#include "firmtouch/scene/stored_name.hpp"

// Byte layout of the objects of an asset (tools/FORMAT.md, section 3e). Little-endian.
namespace firmtouch::scene {

constexpr uint32_t kObjectsSection = 0x8001;
constexpr uint32_t kMaxObjects = 16;

/// An object: a mesh of the same asset, where it begins, how it moves, how it feels.
struct ObjectLayout {
  char name[kNameBytes];
  char mesh[kNameBytes];  // name of the mesh
  float rotation[9];      // rows of own frame -> scene
  float at_m[3];          // of the own frame's origin
  float velocity_mps[3];  // at full speed
  float turn_rad_per_s[3];
  float stiffness_N_per_m;  // FLT_MAX: rigid; 0: air
  float friction_static, friction_dynamic;
};
static_assert(sizeof(ObjectLayout) == 148 && offsetof(ObjectLayout, at_m) == 100);

/// Why opening rejects; the numbers never change. tools/FORMAT.md prints the same text.
enum Rule : uint16_t {
  // The section holds no whole number of objects, or none, or more than 16.
  kRuleObjectCount = 801,
  // A name is not 1 to 31 bytes without control characters, then zeros.
  kRuleObjectName = 802,
  // Two objects have the same name.
  kRuleObjectTwice = 803,
  // The rows of a rotation are no unit vectors across each other, or a mirror image.
  kRuleObjectRotation = 804,
  // An object is more than 10 m from the origin.
  kRuleObjectTooFar = 805,
  // A twist exceeds 100 m/s or 1,000 rad/s.
  kRuleObjectTooFast = 806,
  // A stiffness or friction is negative, or a friction is beyond 100.
  kRuleObjectMaterial = 807,
  // The asset has no mesh of the name that an object states.
  kRuleObjectMesh = 808,
  // The objects are of more than 8 meshes.
  kRuleObjectMeshes = 809,
};

}  // namespace firmtouch::scene
