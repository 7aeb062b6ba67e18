#include "firmtouch/controller/mesh_surface.hpp"

namespace firmtouch {

scene::MeshObject MeshContact::object(const mesh::View& mesh, const params::Values& v) const {
  scene::MeshObject object;
  object.mesh = &mesh;
  object.pose = scene_pose(v);
  object.material = {v[params::kContactStiffness], v[params::kContactDamping]};
  return object;
}

SurfaceReport MeshContact::report() const {
  const mesh::Closest& closest = touch_.closest;
  return {closest.distance_m, touch_.penetration_m, closest.certificate,
          closest.certificate.steps + touch_.base_hull_steps, touch_.is_of_base_hull};
}

SurfaceReport MeshSurface::touch(const params::Values& v, math::Vec3 position_m,
                                 servo::LocalModel& model) {
  scene::touch_mesh(object(mesh(), v), v[params::kToolRadius], position_m,
                    visit_budget(v, params::kMeshSteps), touch_, model);
  return report();
}

void FieldMesh::begin(const asset::Container& asset, const char* name, State& state) {
  get<field::Loader>().prove_against(mesh());
  LoaderChain::begin(asset, name, state);
}

SurfaceReport FieldMesh::touch(const params::Values& v, math::Vec3 position_m,
                               servo::LocalModel& model) {
  scene::MeshObject with_field = object(mesh(), v);
  with_field.distance_field = &distance_field();
  scene::touch_mesh_with_field(with_field, v[params::kToolRadius], position_m,
                               visit_budget(v, params::kMeshSteps), touch_, model);
  return report();
}

SurfaceReport HulledMesh::touch(const params::Values& v, math::Vec3 position_m,
                                servo::LocalModel& model) {
  scene::MeshObject with_hull = object(mesh(), v);
  with_hull.base_hull = &hull().base_hull();
  scene::touch_mesh_with_base_hull(with_hull, v[params::kToolRadius], position_m,
                                   visit_budget(v, params::kMeshSteps), touch_, model);
  return report();
}

void FullMesh::begin(const asset::Container& asset, const char* name, State& state) {
  get<field::Loader>().prove_against(mesh());
  LoaderChain::begin(asset, name, state);
}

SurfaceReport FullMesh::touch(const params::Values& v, math::Vec3 position_m,
                              servo::LocalModel& model) {
  scene::MeshObject with_both = object(mesh(), v);
  with_both.distance_field = &distance_field();
  with_both.base_hull = &hull().base_hull();
  scene::touch_mesh_with_field_and_base_hull(with_both, v[params::kToolRadius], position_m,
                                             visit_budget(v, params::kMeshSteps), touch_, model);
  return report();
}

}  // namespace firmtouch
