#pragma once
#include <vector>

#include "firmtouch/spline/view.hpp"
#include "spline/spline.hpp"

namespace firmtouch::tools {

/// What float32 coefficients leave open between pieces that meet, of the extent.
constexpr double kAssetGap = 1e-6;

/// The pieces of a baked spline as Bezier pieces in double, in the order of the asset, patches cut
/// further so that they meet edge by edge, into at most 16 times as many.
void asset_pieces(const spline::View& view, std::vector<BezierCurve>& curves,
                  std::vector<BezierPatch>& patches);

}  // namespace firmtouch::tools
