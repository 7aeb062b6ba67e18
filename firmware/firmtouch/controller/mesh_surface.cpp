#include "firmtouch/controller/mesh_surface.hpp"

namespace firmtouch {

scene::MeshObject MeshContact::object(const mesh::View& mesh, const params::Values& v) const {
  scene::MeshObject object;
  object.mesh = &mesh;
  object.pose.translation_m = scene_origin_m(v);
  object.material = {v[params::kContactStiffness], v[params::kContactDamping]};
  return object;
}

void MeshContact::report(ModelResult& result) const {
  report_surface(touch_.closest.certificate, touch_.closest.distance_m, touch_.penetration_m,
                 result);
  result.steps += touch_.base_hull_steps;
  if (touch_.is_of_base_hull) result.state |= record::kStateOfBaseHull;
}

void MeshSurface::touch(const ModelRequest& request, const params::Values& v, ModelResult& result) {
  scene::touch_mesh(object(mesh(), v), v[params::kToolRadius], request.position_m,
                    work_budget(v, params::kMeshWork), touch_, result.model);
  report(result);
}

void FieldMesh::touch(const ModelRequest& request, const params::Values& v, ModelResult& result) {
  scene::MeshObject with_field = object(mesh(), v);
  with_field.distance_field = &distance_field();
  scene::touch_mesh_with_field(with_field, v[params::kToolRadius], request.position_m,
                               work_budget(v, params::kMeshWork), touch_, result.model);
  report(result);
}

void HulledMesh::touch(const ModelRequest& request, const params::Values& v, ModelResult& result) {
  scene::MeshObject with_hull = object(mesh(), v);
  with_hull.base_hull = &hull().base_hull();
  scene::touch_mesh_with_base_hull(with_hull, v[params::kToolRadius], request.position_m,
                                   work_budget(v, params::kMeshWork), touch_, result.model);
  report(result);
}

void FullMesh::touch(const ModelRequest& request, const params::Values& v, ModelResult& result) {
  scene::MeshObject with_both = object(mesh(), v);
  with_both.distance_field = &distance_field();
  with_both.base_hull = &hull().base_hull();
  scene::touch_mesh_with_field_and_base_hull(with_both, v[params::kToolRadius], request.position_m,
                                             work_budget(v, params::kMeshWork), touch_,
                                             result.model);
  report(result);
}

}  // namespace firmtouch
