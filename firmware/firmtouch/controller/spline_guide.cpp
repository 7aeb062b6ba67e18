#include "firmtouch/controller/spline_guide.hpp"

namespace firmtouch {

GuideReport SplineGuide::follow(const params::Values& v, uint32_t ticks, math::Vec3 position_m,
                                servo::LocalModel& model) {
  scene::SplineGuide settings;
  set_guide(v, ticks, settings);
  settings.spline = &guide();
  scene::follow_spline(settings, position_m, visit_budget(v, params::kCurveSteps), touch_, model);
  return report(touch_);
}

}  // namespace firmtouch
