#include "firmtouch/controller/mesh_surface.hpp"

#include "firmtouch/scene/mesh_touched.hpp"

namespace firmtouch {
namespace {

void report_penalty(const scene::MeshTouch& touch, ModelResult& result) {
  report_surface(touch.closest.certificate, touch.closest.distance_m, touch.penetration_m, result);
  result.steps += touch.base_hull_steps;
  if (touch.is_of_base_hull) result.state |= record::kStateOfBaseHull;
}

}  // namespace

scene::MeshObject MeshContact::object(const mesh::View& mesh, const params::Values& v) const {
  scene::MeshObject object;
  object.mesh = &mesh;
  object.pose.translation_m = scene_origin_m(v);
  object.material = {v[params::kContactStiffness], v[params::kContactDamping]};
  return object;
}

void MeshSurface::touch(const ModelRequest& request, const params::Values& v, ModelResult& result) {
  scene::MeshObject touched = object(mesh(), v);
  touch_shape(scene::MeshTouched{touched, hint_}, request, v, touch_, result);
}

void MeshSurface::touch_by_penalty(const ModelRequest& request, const params::Values& v,
                                   PenaltyTouch& touch, ModelResult& result) const {
  scene::MeshObject touched = object(mesh(), v);
  scene::touch_mesh(touched, v[params::kToolRadius], request.position_m,
                    work_budget(v, params::kMeshWork, result), touch, result.model);
  report_penalty(touch, result);
}

void FieldMesh::touch(const ModelRequest& request, const params::Values& v, ModelResult& result) {
  scene::MeshObject touched = object(mesh(), v);
  touched.distance_field = &distance_field();
  touch_shape(scene::FieldMeshTouched{touched, hint_}, request, v, touch_, result);
}

void FieldMesh::touch_by_penalty(const ModelRequest& request, const params::Values& v,
                                 PenaltyTouch& touch, ModelResult& result) const {
  scene::MeshObject touched = object(mesh(), v);
  touched.distance_field = &distance_field();
  scene::touch_mesh_with_field(touched, v[params::kToolRadius], request.position_m,
                               work_budget(v, params::kMeshWork, result), touch, result.model);
  report_penalty(touch, result);
}

void HulledMesh::touch(const ModelRequest& request, const params::Values& v, ModelResult& result) {
  scene::MeshObject touched = object(mesh(), v);
  touched.base_hull = &hull().base_hull();
  touch_shape(scene::HulledMeshTouched{touched, hint_}, request, v, touch_, result);
}

void HulledMesh::touch_by_penalty(const ModelRequest& request, const params::Values& v,
                                  PenaltyTouch& touch, ModelResult& result) const {
  scene::MeshObject touched = object(mesh(), v);
  touched.base_hull = &hull().base_hull();
  scene::touch_mesh_with_base_hull(touched, v[params::kToolRadius], request.position_m,
                                   work_budget(v, params::kMeshWork, result), touch, result.model);
  report_penalty(touch, result);
}

void FullMesh::touch(const ModelRequest& request, const params::Values& v, ModelResult& result) {
  scene::MeshObject touched = object(mesh(), v);
  touched.distance_field = &distance_field();
  touched.base_hull = &hull().base_hull();
  touch_shape(scene::FullMeshTouched{touched, hint_}, request, v, touch_, result);
}

void FullMesh::touch_by_penalty(const ModelRequest& request, const params::Values& v,
                                PenaltyTouch& touch, ModelResult& result) const {
  scene::MeshObject touched = object(mesh(), v);
  touched.distance_field = &distance_field();
  touched.base_hull = &hull().base_hull();
  scene::touch_mesh_with_field_and_base_hull(touched, v[params::kToolRadius], request.position_m,
                                             work_budget(v, params::kMeshWork, result), touch,
                                             result.model);
  report_penalty(touch, result);
}

}  // namespace firmtouch
