#pragma once
#include <stdint.h>

#include "firmtouch/asset/container.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/params/entry.hpp"
#include "firmtouch/query/certificate.hpp"
#include "firmtouch/record/tick.hpp"
#include "firmtouch/servo/local_model.hpp"

// What a controller's parts exchange to make a local model.
namespace firmtouch {

struct ModelRequest {
  const asset::Container* asset = nullptr;
  math::Vec3 position_m;
  uint32_t tick = 0;
  bool can_touch = false;  // asset ready, position known, no overload
  bool is_on = false;      // the motors
  bool has_proxy = false;  // servo holds a proxy, at proxy_m
  math::Vec3 proxy_m;
};

/// A local model, and what the record says of how it was made. Surfaces and guides add to both.
struct ModelResult {
  servo::LocalModel model;
  uint32_t ticks = 1;  // since the last model
  float distance_m = 0, distance_lower_m = 0, penetration_m = 0;
  float guide_deviation_m = 0, guide_lower_m = 0, guide_arc = 0;
  uint32_t steps = 0, guide_steps = 0;
  uint32_t work_left = UINT32_MAX;                 // of tick_work
  uint32_t state = 1u << record::kStateSignShift;  // sign unknown
};

/// Adds a surface's query to the record's part. `distance_m` is signed.
void report_surface(const query::Certificate& certificate, float distance_m, float penetration_m,
                    ModelResult& result);
/// Adds a guide's query to the record's part. `arc`: 0 to 1 along the guide.
void report_guide(const query::Certificate& certificate, float deviation_m, float arc, bool is_held,
                  ModelResult& result);

/// What the asset's coordinates count from, in the device frame: its origin, moved by the scene's
/// place. Error: one rounding, of the sum.
math::Vec3 scene_origin_m(const ModelRequest& request, const params::Values& values);
/// Of a row, and of what the tick's other queries have left.
query::Budget work_budget(const params::Values& values, params::Index row,
                          const ModelResult& result);

}  // namespace firmtouch
