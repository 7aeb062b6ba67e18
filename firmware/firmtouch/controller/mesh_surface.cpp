#include "firmtouch/controller/mesh_surface.hpp"

#include "firmtouch/scene/mesh_touched.hpp"

namespace firmtouch {

template <class... Others>
void MeshWith<Others...>::touch(const ModelRequest& request, const params::Values& v,
                                ModelResult& result) {
  const auto touched = object<scene::PlacedMesh>(request, v);
  touch_shape(scene::MeshTouchedWith<kHasField, kHasHull, scene::PlacedMesh>{touched, hint_},
              request, v, touch_, result);
}

template <class... Others>
void MeshWith<Others...>::touch_by_penalty(const ModelRequest& request, const params::Values& v,
                                           PenaltyTouch& touch, ModelResult& result) const {
  scene::touch_mesh<kHasField, kHasHull>(
      object<scene::MeshObject>(request, v), v[params::kToolRadius], request.position_m,
      work_budget(v, params::kMeshWork, result), touch, result.model);
  report_surface(touch.closest.certificate, touch.closest.distance_m, touch.penetration_m, result);
  result.steps += touch.base_hull_steps;
  if (touch.is_of_base_hull) result.state |= record::kStateOfBaseHull;
}

template class MeshWith<>;
template class MeshWith<field::Loader>;
template class MeshWith<hull::Loader>;
template class MeshWith<field::Loader, hull::Loader>;

}  // namespace firmtouch
