#include "firmtouch/controller/material_mesh.hpp"

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch {
namespace {

// The record has the place that the spring pulls to; there the certificate holds.
void report_texture(math::Vec3 proxy_m, ModelResult& result) {
  const float off_m = math::length(result.model.spring.anchor_m - proxy_m);
  result.distance_m += result.distance_m < 0.0f ? -off_m : off_m;
  result.distance_lower_m = math::larger(result.distance_lower_m - off_m, 0.0f);
}

}  // namespace

template <class... Others>
void MaterialMeshWith<Others...>::touch(const ModelRequest& request, const params::Values& v,
                                        ModelResult& result) {
  const scene::MaterialMeshObject object{Mesh::template object<scene::MeshObject>(request, v),
                                         &materials()};
  scene::MeshTouchedWith<Mesh::kHasField, Mesh::kHasHull, scene::MaterialMeshObject> shape{
      object, this->hint_};
  SurfaceTouch& touch = this->touch_;
  use_origin(object.pose.translation_m, touch);
  scene::touch_materials(proxy_contact(request, v, result), object, shape, touch, state_,
                         result.model);
  report_proxy(touch, request.position_m, result);
  if (state_.has_textures && state_.is_held) report_texture(touch.proxy.position_m, result);
  if ((result.state & record::kStateContact) != 0)
    result.state |= uint32_t{state_.material} << record::kStateMaterialShift;
}

template class MaterialMeshWith<>;
template class MaterialMeshWith<field::Loader>;
template class MaterialMeshWith<hull::Loader>;
template class MaterialMeshWith<field::Loader, hull::Loader>;

}  // namespace firmtouch
