#include "firmtouch/controller/spline_guide.hpp"

namespace firmtouch {

void SplineGuide::follow(const ModelRequest& request, const params::Values& v,
                         ModelResult& result) {
  scene::SplineGuide settings;
  set_guide(request, v, result.ticks, settings);
  settings.spline = &guide();
  scene::follow_spline(settings, request.position_m, work_budget(v, params::kGuideWork, result),
                       touch_, result.model);
  report_guide(touch_, result);
}

}  // namespace firmtouch
