#include "firmtouch/controller/curve_guide.hpp"

namespace firmtouch {

void set_guide(const ModelRequest& request, const params::Values& v, uint32_t ticks,
               scene::Guide& guide) {
  guide.pose.translation_m = scene_origin_m(request, v);
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

void report_guide(const scene::GuideTouch& touch, ModelResult& result) {
  const curve::Closest& closest = touch.closest;
  report_guide(closest.certificate, closest.distance_m, closest.arc, touch.is_held, result);
}

void CurveGuide::follow(const ModelRequest& request, const params::Values& v, ModelResult& result) {
  scene::CurveGuide guide;
  set_guide(request, v, result.ticks, guide);
  guide.curve = &curve();
  scene::follow_curve(guide, request.position_m, work_budget(v, params::kGuideWork, result), touch_,
                      result.model);
  report_guide(touch_, result);
}

}  // namespace firmtouch
