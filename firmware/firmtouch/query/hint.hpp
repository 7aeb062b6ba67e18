#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"

namespace firmtouch::query {

constexpr uint32_t kNowhere = UINT32_MAX;

/// What the hints of all geometries share: the certificate of the last query.
///
/// A geometry's Hint is what its query leaves for the next one of the same (tool, object) pair. The
/// caller owns it; its fields are the geometry's own. A default hint is a cold start. Reset it
/// after a jump to another asset: a certificate of another shape would make answers wrong. After a
/// lost tick or a jump in space it costs visits and cannot make an answer wrong.
struct HintBase {
  math::Vec3 position_m;  // of the last query
  float lower_m = 0;      // certified free radius about position_m
  int8_t sign = 0;        // certified sign at position_m
};

}  // namespace firmtouch::query
