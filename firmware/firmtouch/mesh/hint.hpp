#pragma once
#include "firmtouch/query/hint.hpp"

namespace firmtouch::mesh {

/// What a query of a mesh leaves for the next one (query/hint.hpp). No value of the leaf slot or
/// the triangle can make an answer wrong.
struct Hint : query::HintBase {
  uint16_t triangle_low = 0;                // low half of the last triangle; for the wide search
  uint32_t leaf_slot = query::kNowhere;     // of the last answer: node << 1 | side
  uint32_t safe_subtree = query::kNowhere;  // a node; all triangles outside its subtree are ...
  float safe_subtree_m = 0;                 // ... certified at least this far from position_m
};

}  // namespace firmtouch::mesh
