#pragma once
#include <float.h>
#include <stdint.h>

#include "firmtouch/scene/stored_name.hpp"

// Byte layout of the materials of a mesh's triangles (tools/FORMAT.md, section 3f). Little-endian.
namespace firmtouch::scene {

// All share the name of their mesh.
constexpr uint32_t kMaterialsSection = 0x1011;          // MaterialLayout[1 to kMaxMaterials]
constexpr uint32_t kTriangleMaterialsSection = 0x1012;  // uint8_t[triangle_count], in leaf order
constexpr uint32_t kTexturesSection = 0x1013;           // TextureLayout[materials], or none

constexpr uint32_t kMaxMaterials = 255;  // a triangle names one in a byte

/// How triangles feel. Material k of a triangle is the k-th of the table, from 1; 0: none.
struct MaterialLayout {
  char name[kNameBytes];
  float stiffness_N_per_m;  // in series with the tool's; FLT_MAX: rigid
  float friction_static, friction_dynamic;
  float friction_viscous_N_s_per_m;
};
static_assert(sizeof(MaterialLayout) == 48);

/// A wave of a surface's height: height_m (1 - cos(2 pi per_m . x)) / 2 below the triangle, with x
/// the tool in the mesh's frame. All zero: none.
struct WaveLayout {
  float per_m[3];  // waves a metre, along each axis
  float height_m;  // from crest to trough
};
/// One wave makes grooves, two across each other a grid. They add up.
struct TextureLayout {
  WaveLayout wave[2];
};
static_assert(sizeof(TextureLayout) == 32);

// Of the sum of both waves. With a slope below 1 the force grows with the penetration everywhere.
constexpr float kMaxTextureHeight_m = 0.002f;
constexpr float kMaxTextureSlope = 0.75f;
constexpr float kMaxWaves_per_m = 1e5f;  // in each axis

constexpr float kMinMaterialStiffness_N_per_m = 1e-3f;
constexpr float kMaxMaterialFriction = 100;
constexpr float kMaxMaterialViscous_N_s_per_m = 1000;

/// Why opening rejects; the numbers never change. tools/FORMAT.md prints the same text.
enum MaterialRule : uint16_t {
  // The section holds no whole number of materials, or none, or more than 255.
  kRuleMaterialCount = 821,
  // A name is not 1 to 31 bytes without control characters, then zeros.
  kRuleMaterialName = 822,
  // Two materials have the same name.
  kRuleMaterialTwice = 823,
  // A stiffness is below 0.001 N/m, a friction not 0 to 100, or viscous friction not 0 to 1,000.
  kRuleMaterialValue = 824,
  // There is not one byte a triangle.
  kRuleMaterialBytes = 825,
  // A triangle names a material behind the end of the table.
  kRuleMaterialIndex = 826,
  // There are textures, but not one a material.
  kRuleTextureCount = 827,
  // The waves of a texture are higher than 2 mm, steeper than 0.75, or more than 100,000 a metre.
  kRuleTextureValue = 828,
};

}  // namespace firmtouch::scene
