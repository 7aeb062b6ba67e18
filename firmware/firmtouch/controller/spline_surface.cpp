#include "firmtouch/controller/spline_surface.hpp"

namespace firmtouch {

void SplineSurface::touch(const ModelRequest& request, const params::Values& v,
                          ModelResult& result) {
  scene::SplineObject object;
  object.surface = &surface();
  object.pose.translation_m = scene_origin_m(v);
  object.material = {v[params::kContactStiffness], v[params::kContactDamping]};
  object.is_turned = v[params::kSurfaceTurned] >= 0.5f;
  object.is_closed = v[params::kSurfaceClosed] >= 0.5f;
  scene::touch_spline(object, v[params::kToolRadius], request.position_m,
                      work_budget(v, params::kMeshWork), touch_, result.model);
  const spline::Closest& closest = touch_.closest;
  const bool is_inside = closest.certificate.sign < 0;
  report_surface(closest.certificate, is_inside ? -closest.distance_m : closest.distance_m,
                 touch_.penetration_m, result);
}

}  // namespace firmtouch
