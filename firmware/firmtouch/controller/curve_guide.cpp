#include "firmtouch/controller/curve_guide.hpp"

namespace firmtouch {

void set_guide(const params::Values& v, uint32_t ticks, scene::Guide& guide) {
  guide.pose = scene_pose(v);
  guide.material = {v[params::kGuideStiffness], v[params::kGuideDamping]};
  guide.snap_m = v[params::kGuideSnap];
  guide.release_m = v[params::kGuideRelease];
  guide.tunnel_m = v[params::kGuideTunnel];
  guide.arc_penalty = v[params::kGuideArcPenalty];
  guide.free_side = {v[params::kGuideSideX], v[params::kGuideSideY], v[params::kGuideSideZ]};
  guide.ends = static_cast<scene::Ends>(static_cast<uint8_t>(v[params::kGuideEnds]));
  guide.drive = {static_cast<scene::Drive::Kind>(static_cast<uint8_t>(v[params::kGuideDrive])),
                 v[params::kGuideDriveForce], v[params::kGuideDriveSpeed],
                 static_cast<float>(ticks) * v[params::kTickPeriod]};
}

GuideReport report(const scene::GuideTouch& touch) {
  const curve::Closest& closest = touch.closest;
  return {closest.distance_m, closest.arc, closest.certificate, touch.is_held};
}

GuideReport CurveGuide::follow(const params::Values& v, uint32_t ticks, math::Vec3 position_m,
                               servo::LocalModel& model) {
  scene::CurveGuide guide;
  set_guide(v, ticks, guide);
  guide.curve = &curve();
  scene::follow_curve(guide, position_m, visit_budget(v, params::kCurveSteps), touch_, model);
  return report(touch_);
}

}  // namespace firmtouch
