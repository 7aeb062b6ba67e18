#pragma once
#include "firmtouch/controller/first_of.hpp"
#include "firmtouch/controller/mesh_surface.hpp"
#include "firmtouch/scene/material_touch.hpp"
#include "firmtouch/scene/mesh_touched.hpp"

namespace firmtouch {

/// Proves the materials of a mesh (asset/loading.hpp).
using MaterialsLoader =
    asset::PartLoader<scene::MaterialsProof, scene::kMaterialsSection, mesh::View>;

/// A surface policy: a mesh whose triangles have materials, if the asset has them. Stiffness is in
/// series with contact_stiffness, friction the larger of the material's and the parameters'. For a
/// mesh without materials the same bits as MeshWith<Others...>. With textures the record's proxy_m
/// is the place that the spring pulls to, about the height below the proxy; so is its certificate.
template <class... Others>
class MaterialMeshWith : public MeshWith<Others..., MaterialsLoader>, public TexturedSurface {
  using Mesh = MeshWith<Others..., MaterialsLoader>;

 public:
  static constexpr uint32_t kParts = Mesh::kParts | kPartMaterials;

  MaterialMeshWith() { this->template get<MaterialsLoader>().prove_against(this->mesh()); }
  const scene::StoredMaterials& materials() const {
    return this->template get<MaterialsLoader>().view();
  }
  scene::Stiffening stiffening() const { return materials().stiffening(); }
  /// Of the last model: what the materials that are touched add to contact().
  const scene::MaterialTouch& touched() const { return state_; }
  void reset() {
    Mesh::reset();
    state_ = {};
  }
  void touch(const ModelRequest& request, const params::Values& values, ModelResult& result);

 private:
  scene::MaterialTouch state_;
};

using MaterialMesh = MaterialMeshWith<>;
using FieldMaterialMesh = MaterialMeshWith<field::Loader>;
using HulledMaterialMesh = MaterialMeshWith<hull::Loader>;
using FullMaterialMesh = MaterialMeshWith<field::Loader, hull::Loader>;

extern template class MaterialMeshWith<>;
extern template class MaterialMeshWith<field::Loader>;
extern template class MaterialMeshWith<hull::Loader>;
extern template class MaterialMeshWith<field::Loader, hull::Loader>;

}  // namespace firmtouch
