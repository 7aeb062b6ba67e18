#pragma once
#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/mesh/view.hpp"
#include "firmtouch/query/staged_check.hpp"
#include "firmtouch/scene/texture.hpp"

namespace firmtouch::scene {

/// The bytes of the sections that say how a mesh's triangles feel.
struct MaterialSections {
  core::Bytes table, triangles, textures, reliefs, samples;

  /// Calls take(section type, bytes) for each.
  template <class Take>
  void each(const Take& take) {
    take(kMaterialsSection, table), take(kTriangleMaterialsSection, triangles);
    take(kTexturesSection, textures), take(kReliefsSection, reliefs);
    take(kReliefSamplesSection, samples);
  }
};

/// Materials that Opening has proven against their mesh. Immutable.
class StoredMaterials {
 public:
  using Sections = MaterialSections;
  bool is_open() const { return !table_.empty(); }
  core::Span<const MaterialLayout> table() const { return table_; }
  /// One a material, or none.
  core::Span<const TextureLayout> textures() const { return textures_; }
  core::Span<const ReliefLayout> reliefs() const { return reliefs_; }
  const core::Bytes& samples() const { return samples_; }
  bool has_textures() const { return !textures_.empty() || !reliefs_.empty(); }
  /// The texture of a material, from 1; none of another number.
  Cut cut_of(uint32_t material, math::Vec3 x_m) const;
  const Stiffening& stiffening() const { return stiffening_; }
  /// Of a triangle: 1 + its place in the table; 0: none, also where nothing is open.
  /// Pre: the triangle is one of the mesh.
  uint8_t of(uint32_t triangle) const { return is_open() ? triangles_[triangle] : uint8_t{0}; }

 private:
  friend class MaterialsProof;
  core::Span<const MaterialLayout> table_;
  core::Span<const TextureLayout> textures_;
  core::Span<const ReliefLayout> reliefs_;
  core::Bytes triangles_, samples_;
  Stiffening stiffening_;
};

/// What Opening proves of materials: rules R821 to R830 of tools/FORMAT.md.
class MaterialsProof {
 public:
  static const query::CheckStage kStages[4];
  /// `mesh` is open.
  core::Verdict take(const MaterialSections& sections, const mesh::View& mesh);
  core::Verdict check_head() const { return core::kPassed; }
  StoredMaterials view;

 private:
  static constexpr uint32_t kSliceTriangles = 16;  // about 100 instructions

  uint32_t material_count() const { return view.table_.size(); }
  uint32_t slice_count() const;
  uint32_t texture_count() const { return view.has_textures() ? view.table_.size() : 0; }
  uint32_t relief_count() const { return view.reliefs_.size(); }
  core::Verdict check_material(uint32_t i);
  core::Verdict check_texture(uint32_t i);
  core::Verdict check_relief(uint32_t i);
  core::Verdict check_slice(uint32_t i);
};

using MaterialsOpening = query::Opening<MaterialsProof>;

/// All at once.
inline core::Verdict open(const MaterialSections& sections, const mesh::View& mesh,
                          StoredMaterials& to) {
  return query::open_at_once<MaterialsOpening>(to, sections, mesh);
}

}  // namespace firmtouch::scene

extern template class firmtouch::query::Opening<firmtouch::scene::MaterialsProof>;
