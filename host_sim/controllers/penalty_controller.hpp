#pragma once
#include "firmtouch/controller/full_controller.hpp"

namespace firmtouch::host_sim {

/// The controller of every part with penalty contact instead of a proxy, for comparison.
using PenaltyController = Controller<Surfaces<Penalty<FullMesh>, Penalty<SplineSurface>>,
                                     Guides<CurveGuide, SplineGuide>>;

}  // namespace firmtouch::host_sim
