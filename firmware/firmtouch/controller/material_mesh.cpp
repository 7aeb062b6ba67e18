#include "firmtouch/controller/material_mesh.hpp"

namespace firmtouch {

template <class... Others>
void MaterialMeshWith<Others...>::touch(const ModelRequest& request, const params::Values& v,
                                        ModelResult& result) {
  const scene::MaterialMeshObject object{Mesh::object(v), &materials()};
  scene::MeshTouchedWith<Mesh::kHasField, Mesh::kHasHull, scene::MaterialMeshObject> shape{
      object, this->hint_};
  SurfaceTouch& touch = this->touch_;
  use_origin(scene_origin_m(v), touch);
  scene::touch_materials(proxy_contact(request, v, result), materials(), shape, touch, state_,
                         result.model);
  report_proxy(touch, request.position_m, result);
  if ((result.state & record::kStateContact) != 0)
    result.state |= uint32_t{state_.material} << record::kStateMaterialShift;
}

template class MaterialMeshWith<>;
template class MaterialMeshWith<field::Loader>;
template class MaterialMeshWith<hull::Loader>;
template class MaterialMeshWith<field::Loader, hull::Loader>;

}  // namespace firmtouch
