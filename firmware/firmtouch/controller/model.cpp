#include "firmtouch/controller/model.hpp"

namespace firmtouch {

void report(const SurfaceReport& surface, const GuideReport& guide, ModelResult& result) {
  result.distance_m = surface.distance_m;
  result.distance_lower_m = surface.certificate.lower_m;
  result.penetration_m = surface.penetration_m;
  result.guide_deviation_m = guide.deviation_m;
  result.guide_lower_m = guide.certificate.lower_m;
  result.guide_arc = guide.arc;
  result.steps = surface.steps + guide.certificate.steps;
  result.guide_steps = guide.certificate.steps;
  result.state = static_cast<uint32_t>(surface.certificate.sign + 1) << record::kStateSignShift;
  if (surface.penetration_m > 0) result.state |= record::kStateContact;
  if (surface.is_of_base_hull) result.state |= record::kStateOfBaseHull;
  if (guide.is_held) result.state |= record::kStateOnGuide;
  if (surface.certificate.exact) result.state |= record::kStateExact;
  if (guide.certificate.exact) result.state |= record::kStateGuideExact;
}

math::RigidTransform scene_pose(const params::Values& values) {
  return {{}, {values[params::kSceneX], values[params::kSceneY], values[params::kSceneZ]}};
}

query::Budget visit_budget(const params::Values& values, params::Index row) {
  return {static_cast<uint32_t>(values[row])};
}

}  // namespace firmtouch
