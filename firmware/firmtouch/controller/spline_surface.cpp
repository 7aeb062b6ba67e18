#include "firmtouch/controller/spline_surface.hpp"

#include "firmtouch/scene/spline_touched.hpp"

namespace firmtouch {

scene::SplineObject SplineSurface::object(const ModelRequest& request,
                                          const params::Values& v) const {
  scene::SplineObject object;
  object.surface = &surface();
  object.pose.translation_m = scene_origin_m(request, v);
  object.material = {v[params::kContactStiffness], v[params::kContactDamping]};
  object.is_turned = v[params::kSurfaceTurned] >= 0.5f;
  object.is_closed = v[params::kSurfaceClosed] >= 0.5f;
  return object;
}

void SplineSurface::touch(const ModelRequest& request, const params::Values& v,
                          ModelResult& result) {
  const scene::SplineObject touched_object = object(request, v);
  touch_shape(scene::SplineTouched{touched_object, hint_}, request, v, touch_, result);
}

void SplineSurface::touch_by_penalty(const ModelRequest& request, const params::Values& v,
                                     PenaltyTouch& touch, ModelResult& result) const {
  scene::touch_spline(object(request, v), v[params::kToolRadius], request.position_m,
                      work_budget(v, params::kMeshWork, result), touch, result.model);
  const spline::Closest& closest = touch.closest;
  const bool is_inside = closest.certificate.sign < 0;
  report_surface(closest.certificate, is_inside ? -closest.distance_m : closest.distance_m,
                 touch.penetration_m, result);
}

}  // namespace firmtouch
