#pragma once
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"

namespace firmtouch::query {

constexpr uint32_t kNowhere = UINT32_MAX;

/// What a query leaves for the next one of the same (tool, object) pair; the caller owns it and
/// never reads it. A default hint is a cold start. A reset, a jump or a lost tick costs steps and
/// cannot make an answer wrong; nor can any value of `place`. The rest is a certificate: what a
/// query of another asset wrote must not be passed on.
struct Hint {
  uint32_t place = kNowhere;  // where the last answer was found (the module's own numbering)
  math::Vec3 position_m;      // where the last query was
  float lower_m = 0;          // certified free radius about position_m
  int8_t sign = 0;            // certified side of position_m
  uint8_t fine[2] = {0, 0};   // more of `place`, where a module has more to say of it
  uint32_t safe_subtree =
      kNowhere;              // a part of the shape (the module's own numbering), outside which ...
  float safe_subtree_m = 0;  // ... everything is certified at least this far from position_m
};

}  // namespace firmtouch::query
