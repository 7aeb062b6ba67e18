#pragma once
#include "bench/bench.hpp"

namespace firmtouch::bench {

/// The drag that an arc penalty makes at corners, over a range of weights: of the published
/// constraint, and of the guide that goes on along the curve by distance.
void run_drag(Report& report);

}  // namespace firmtouch::bench
