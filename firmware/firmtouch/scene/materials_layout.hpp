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

constexpr uint32_t kReliefsSection = 0x1014;        // ReliefLayout[materials], or none
constexpr uint32_t kReliefSamplesSection = 0x1015;  // uint8_t, of all maps

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

/// A periodic tile of side * side samples, from `first` on, row by row (scene/relief.hpp).
/// Tiles lie along u and v: sample (row v, column u) is where u_per_m . x and v_per_m . x are v /
/// side and u / side past whole numbers. All zero: none.
struct ReliefLayout {
  float u_per_m[3], v_per_m[3];  // tiles a metre, along each axis
  float height_m;                // below the triangle, of a sample of 255; 0 is at it
  float slope, per_m;            // at least what bounds_of() the samples is
  uint32_t first, side;
};
static_assert(sizeof(ReliefLayout) == 44);
constexpr uint32_t kMinReliefSide = 4, kMaxReliefSide = 64;  // a power of two

// Of the sum of waves and map. With a slope below 1 the force grows with the penetration
// everywhere.
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
  // There are textures or height maps, but not one a material.
  kRuleTextureCount = 827,
  // Waves and map together are higher than 2 mm, steeper than 0.75, or more than 100,000 a metre.
  kRuleTextureValue = 828,
  // A height map has a side that is no power of two from 4 to 64, or samples outside its section.
  kRuleReliefSamples = 829,
  // A height map is steeper, or curves more, than it states.
  kRuleReliefBounds = 830,
};

}  // namespace firmtouch::scene
