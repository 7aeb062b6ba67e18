#pragma once
#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/curve/view.hpp"
#include "firmtouch/mesh/view.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::target {

struct Views {
  mesh::View mesh;    // the asset's first, if it has one
  curve::View curve;  // the same
  spline::View spline;
  core::Verdict verdict;
};

/// Opens the asset that begins at `region`, which may be longer.
Views open_views(core::Bytes region);

}  // namespace firmtouch::target
