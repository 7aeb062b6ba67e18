#include "firmtouch/controller/spline_surface.hpp"

namespace firmtouch {

SurfaceReport SplineSurface::touch(const params::Values& v, math::Vec3 position_m,
                                   servo::LocalModel& model) {
  scene::SplineObject object;
  object.surface = &surface();
  object.pose = scene_pose(v);
  object.material = {v[params::kContactStiffness], v[params::kContactDamping]};
  object.is_turned = v[params::kSurfaceTurned] >= 0.5f;
  object.is_closed = v[params::kSurfaceClosed] >= 0.5f;
  scene::touch_spline(object, v[params::kToolRadius], position_m,
                      visit_budget(v, params::kMeshSteps), touch_, model);
  const spline::Closest& closest = touch_.closest;
  const bool is_inside = closest.certificate.sign < 0;
  return {is_inside ? -closest.distance_m : closest.distance_m, touch_.penetration_m,
          closest.certificate, closest.certificate.steps, false};
}

}  // namespace firmtouch
