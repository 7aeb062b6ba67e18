#include "firmtouch/scene/stored_materials.hpp"

#include "firmtouch/core/bytes.hpp"
#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/relief.hpp"

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

// Adds the waves of a texture; false where one has no sound direction or height.
bool add_waves(const TextureLayout& texture, float& height_m, float& slope) {
  constexpr float kPi = 3.14159274f;
  for (const WaveLayout& wave : texture.wave) {
    const math::Vec3 per_m{wave.per_m[0], wave.per_m[1], wave.per_m[2]};
    if (!math::is_within(per_m, kMaxWaves_per_m) || !(wave.height_m >= 0.0f)) return false;
    height_m += wave.height_m;
    slope += kPi * wave.height_m * math::length(per_m);
  }
  return true;
}

bool add_relief(const ReliefLayout& relief, float& height_m, float& slope) {
  const math::Vec3 u_per_m{relief.u_per_m[0], relief.u_per_m[1], relief.u_per_m[2]};
  const math::Vec3 v_per_m{relief.v_per_m[0], relief.v_per_m[1], relief.v_per_m[2]};
  height_m += relief.height_m;
  slope += relief.slope;
  return math::is_within(u_per_m, kMaxWaves_per_m) && math::is_within(v_per_m, kMaxWaves_per_m) &&
         relief.height_m >= 0.0f && relief.slope >= 0.0f && is_between(relief.per_m, 0.0f, FLT_MAX);
}

}  // namespace

Cut StoredMaterials::cut_of(uint32_t material, math::Vec3 x_m) const {
  Cut cut;
  if (material == 0 || material > table_.size()) return cut;
  if (!textures_.empty()) cut = cut_at(textures_[material - 1], x_m);
  if (!reliefs_.empty()) scene::add_relief(reliefs_[material - 1], samples_.data(), x_m, cut);
  return cut;
}

using Stage = query::StageOf<MaterialsProof>;

// A name may be compared with 254 others; a map may have 4,096 samples.
const query::CheckStage MaterialsProof::kStages[4] = {
    Stage::of<&MaterialsProof::material_count, &MaterialsProof::check_material>(350),
    Stage::of<&MaterialsProof::texture_count, &MaterialsProof::check_texture>(2),
    Stage::of<&MaterialsProof::relief_count, &MaterialsProof::check_relief>(1700),
    Stage::of<&MaterialsProof::slice_count, &MaterialsProof::check_slice>(1)};

Verdict MaterialsProof::take(const MaterialSections& sections, const mesh::View& mesh) {
  const auto table = core::as_whole_array<MaterialLayout>(sections.table);
  if (table.empty() || table.size() > kMaxMaterials) return reject(kRuleMaterialCount);
  view.triangles_ = sections.triangles;
  if (view.triangles_.size() != mesh.head().triangle_count) return reject(kRuleMaterialBytes);
  view.textures_ = core::as_whole_array<TextureLayout>(sections.textures);
  view.reliefs_ = core::as_whole_array<ReliefLayout>(sections.reliefs);
  view.samples_ = sections.samples;
  const bool has_textures = sections.textures.size() > 0, has_reliefs = sections.reliefs.size() > 0;
  if ((has_textures && view.textures_.size() != table.size()) ||
      (has_reliefs && view.reliefs_.size() != table.size()))
    return reject(kRuleTextureCount);
  view.stiffening_ = stiffening_of(view.textures_, view.reliefs_);
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
  float height_m = 0, slope = 0;
  const bool is_sound = (view.textures_.empty() || add_waves(view.textures_[i], height_m, slope)) &&
                        (view.reliefs_.empty() || add_relief(view.reliefs_[i], height_m, slope));
  if (is_sound && height_m <= kMaxTextureHeight_m && slope <= kMaxTextureSlope)
    return core::kPassed;
  return reject(kRuleTextureValue, i);
}

Verdict MaterialsProof::check_relief(uint32_t i) {
  const ReliefLayout& relief = view.reliefs_[i];
  if (!(relief.height_m > 0.0f)) return core::kPassed;
  const uint32_t side = relief.side, count = view.samples_.size();
  if (side < kMinReliefSide || side > kMaxReliefSide || (side & (side - 1)) != 0 ||
      relief.first > count || side * side > count - relief.first)
    return reject(kRuleReliefSamples, i);
  const ReliefBounds bounds = bounds_of(relief, view.samples_.data());
  return bounds.slope <= relief.slope && bounds.per_m <= relief.per_m
             ? core::kPassed
             : reject(kRuleReliefBounds, i);
}

Verdict MaterialsProof::check_slice(uint32_t i) {
  const uint32_t first = i * kSliceTriangles;
  for (uint32_t t = first; t < first + kSliceTriangles && t < view.triangles_.size(); ++t)
    if (view.triangles_[t] > view.table_.size()) return reject(kRuleMaterialIndex, t);
  return core::kPassed;
}

}  // namespace firmtouch::scene

template class firmtouch::query::Opening<firmtouch::scene::MaterialsProof>;
