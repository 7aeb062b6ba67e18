#include "firmtouch/scene/stored_materials.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::scene {
namespace {

using core::reject;
using core::Verdict;

// Written so that NaN fails.
bool is_between(float value, float low, float high) { return value >= low && value <= high; }

bool is_sound(const MaterialLayout& material) {
  return is_between(material.stiffness_N_per_m, kMinMaterialStiffness_N_per_m, FLT_MAX) &&
         is_between(material.friction_static, 0.0f, kMaxMaterialFriction) &&
         is_between(material.friction_dynamic, 0.0f, kMaxMaterialFriction) &&
         is_between(material.friction_viscous_N_s_per_m, 0.0f, kMaxMaterialViscous_N_s_per_m);
}

bool is_sound(const TextureLayout& texture) {
  constexpr float kPi = 3.14159274f;
  float height_m = 0, slope = 0;
  for (const WaveLayout& wave : texture.wave) {
    const math::Vec3 per_m{wave.per_m[0], wave.per_m[1], wave.per_m[2]};
    if (!math::is_within(per_m, kMaxWaves_per_m) || !(wave.height_m >= 0.0f)) return false;
    height_m += wave.height_m;
    slope += kPi * wave.height_m * math::length(per_m);
  }
  return height_m <= kMaxTextureHeight_m && slope <= kMaxTextureSlope;
}

}  // namespace

using Of = query::StageOf<MaterialsProof>;

// A name may be compared with 254 others.
const query::CheckStage MaterialsProof::kStages[3] = {
    {350, Of::count<&MaterialsProof::material_count>, Of::each<&MaterialsProof::check_material>},
    {2, Of::count<&MaterialsProof::texture_count>, Of::each<&MaterialsProof::check_texture>},
    {1, Of::count<&MaterialsProof::slice_count>, Of::each<&MaterialsProof::check_slice>}};

Verdict MaterialsProof::take(const MaterialSections& sections, const mesh::View& mesh) {
  const auto table = core::as_whole_array<MaterialLayout>(sections.table);
  if (table.empty() || table.size() > kMaxMaterials) return reject(kRuleMaterialCount);
  view.triangles_ = sections.triangles;
  if (view.triangles_.size() != mesh.head().triangle_count) return reject(kRuleMaterialBytes);
  view.textures_ = core::as_whole_array<TextureLayout>(sections.textures);
  const bool has_textures = sections.textures.size() > 0;
  if (has_textures && view.textures_.size() != table.size()) return reject(kRuleTextureCount);
  view.stiffening_ = stiffening_of(view.textures_);
  view.table_ = table;
  return core::kPassed;
}

uint32_t MaterialsProof::slice_count() const {
  return (view.triangles_.size() + kSliceTriangles - 1) / kSliceTriangles;
}

Verdict MaterialsProof::check_material(uint32_t i) {
  const MaterialLayout& material = view.table_[i];
  if (!is_name(material.name)) return reject(kRuleMaterialName, i);
  for (uint32_t k = 0; k < i; ++k)
    if (is_same_name(view.table_[k].name, material.name)) return reject(kRuleMaterialTwice, i);
  return is_sound(material) ? core::kPassed : reject(kRuleMaterialValue, i);
}

Verdict MaterialsProof::check_texture(uint32_t i) {
  return is_sound(view.textures_[i]) ? core::kPassed : reject(kRuleTextureValue, i);
}

Verdict MaterialsProof::check_slice(uint32_t i) {
  const uint32_t first = i * kSliceTriangles;
  for (uint32_t t = first; t < first + kSliceTriangles && t < view.triangles_.size(); ++t)
    if (view.triangles_[t] > view.table_.size()) return reject(kRuleMaterialIndex, t);
  return core::kPassed;
}

}  // namespace firmtouch::scene

template class firmtouch::query::Opening<firmtouch::scene::MaterialsProof>;
