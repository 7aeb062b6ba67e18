#pragma once
#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/curve/view.hpp"
#include "firmtouch/mesh/view.hpp"

namespace firmtouch::target {

struct Views {
  mesh::View mesh;    // the asset's first, if it has one
  curve::View curve;  // the same
  core::Verdict verdict;
};

/// Opens the asset that begins at `region`, which may be longer.
Views open_views(core::Bytes region);

}  // namespace firmtouch::target
