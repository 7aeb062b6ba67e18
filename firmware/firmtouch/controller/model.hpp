#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"
#include "firmtouch/params/entry.hpp"
#include "firmtouch/query/certificate.hpp"
#include "firmtouch/record/tick.hpp"
#include "firmtouch/servo/local_model.hpp"

// What a controller's parts exchange to make a local model.
namespace firmtouch {

struct ModelRequest {
  math::Vec3 position_m;
  uint32_t tick = 0;
  bool can_touch = false;  // the asset is ready and the position known
};

/// What a surface reports of its query.
struct SurfaceReport {
  float distance_m = 0;  // signed
  float penetration_m = 0;
  query::Certificate certificate;
  uint32_t steps = 0;
  bool is_of_base_hull = false;
};

/// What a guide reports of its query.
struct GuideReport {
  float deviation_m = 0;
  float arc = 0;  // 0 to 1 along the guide
  query::Certificate certificate;
  bool is_held = false;
};

/// A local model, and what the record says of how it was made.
struct ModelResult {
  servo::LocalModel model;
  float distance_m = 0, distance_lower_m = 0, penetration_m = 0;
  float guide_deviation_m = 0, guide_lower_m = 0, guide_arc = 0;
  uint32_t steps = 0, guide_steps = 0;
  uint32_t state = 1u << record::kStateSignShift;  // sign unknown
};

/// Fills all but the model.
void report(const SurfaceReport& surface, const GuideReport& guide, ModelResult& result);

/// The scene's pose, and the visit budget of a row.
math::RigidTransform scene_pose(const params::Values& values);
query::Budget visit_budget(const params::Values& values, params::Index row);

}  // namespace firmtouch
