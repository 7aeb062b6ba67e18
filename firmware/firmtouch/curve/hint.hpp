#pragma once
#include "firmtouch/query/hint.hpp"

namespace firmtouch::curve {

/// What a query of a curve leaves for the next one (query/hint.hpp). No value of the segment can
/// make an answer wrong.
struct Hint : query::HintBase {
  uint32_t segment = query::kNowhere;       // of the last answer
  uint32_t safe_subtree = query::kNowhere;  // a node; all segments outside its subtree are ...
  float safe_subtree_m = 0;                 // ... certified at least this far from position_m
};

}  // namespace firmtouch::curve
