#pragma once
#include <stdint.h>

#include "firmtouch/query/hint.hpp"

namespace firmtouch::spline {

/// Parts of a surface's tree, each with how far it is at least, and how far all that is in none of
/// them is: so many units beyond base_m, from where the last query was. A certificate, as lower_m
/// is: what a query of another asset wrote makes answers wrong, though never reads what is not
/// there.
struct Frontier {
  // Where most of a model is about as near, 64 have no room for what is within reach
  // (spline/README.md, "Coherence").
  static constexpr uint32_t kMax = 128;

  float base_m = 0.0f;  // less all motion since it was stored: may be below 0
  float unit_m = 0.0f;  // 0: nothing is known
  uint8_t count = 0;
  uint8_t outside = 0;
  uint8_t beyond[kMax] = {};
  uint32_t node[kMax] = {};
};

/// Hint::safe_subtree of a surface whose frontier is of position_m. A query that leaves no frontier
/// leaves query::kNowhere.
constexpr uint32_t kWithFrontier = 0;

/// What a query of a spline curve leaves for the next one (query/hint.hpp). A surface queried with
/// it returns the same, with more visits. No value of `foot` and `fine` can make an answer wrong.
struct CurveHint : query::HintBase {
  uint32_t foot = query::kNowhere;          // piece and parameter of the last answer
  uint8_t fine[2] = {0, 0};                 // lower bits of a surface's two parameters
  uint32_t safe_subtree = query::kNowhere;  // leaves; all outside them is ...
  float safe_subtree_m = 0;                 // ... certified at least this far from position_m
};

/// The same of a surface.
struct Hint : CurveHint {
  Frontier frontier;
};

}  // namespace firmtouch::spline
