#include "firmtouch/controller/model.hpp"

namespace firmtouch {

void report_surface(const query::Certificate& certificate, float distance_m, float penetration_m,
                    ModelResult& result) {
  result.distance_m = distance_m;
  result.distance_lower_m = certificate.lower_m;
  result.penetration_m = penetration_m;
  result.steps += certificate.steps;
  result.work_left -= certificate.work < result.work_left ? certificate.work : result.work_left;
  result.state &= ~(3u << record::kStateSignShift);
  result.state |= static_cast<uint32_t>(certificate.sign + 1) << record::kStateSignShift;
  if (penetration_m > 0) result.state |= record::kStateContact;
  if (certificate.exact) result.state |= record::kStateExact;
}

void report_guide(const query::Certificate& certificate, float deviation_m, float arc, bool is_held,
                  ModelResult& result) {
  result.guide_deviation_m = deviation_m;
  result.guide_lower_m = certificate.lower_m;
  result.guide_arc = arc;
  result.steps += certificate.steps;
  result.guide_steps = certificate.steps;
  if (is_held) result.state |= record::kStateOnGuide;
  if (certificate.exact) result.state |= record::kStateGuideExact;
}

math::Vec3 scene_origin_m(const ModelRequest& request, const params::Values& values) {
  const math::Vec3 asset_m = request.asset == nullptr ? math::Vec3{} : request.asset->origin_m();
  return {values[params::kSceneX] + asset_m.x, values[params::kSceneY] + asset_m.y,
          values[params::kSceneZ] + asset_m.z};
}

query::Budget work_budget(const params::Values& values, params::Index row,
                          const ModelResult& result) {
  const auto most = static_cast<uint32_t>(values[row]);
  return {most < result.work_left ? most : result.work_left};
}

}  // namespace firmtouch
