#pragma once
#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "firmtouch/curve/view.hpp"
#include "firmtouch/mesh/view.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::target {

struct Views {
  mesh::View mesh;    // first mesh of the asset, if any
  curve::View curve;  // first curve
  spline::View spline;
  core::Verdict verdict;
};

/// Opens the asset at the start of `region`, which may be longer.
Views open_views(core::Bytes region);

}  // namespace firmtouch::target
