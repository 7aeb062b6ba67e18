#pragma once
#include "bench/bench.hpp"

namespace firmtouch::bench {

/// The drag that an arc penalty makes at corners, over a range of weights: of the published
/// constraint, and of the guide that goes on along the curve by distance.
void run_drag(Report& report);

/// How much the force of a guide changes from tick to tick at 1 kHz and 100 mm/s, straight and cubic
/// pieces: the bar.
void run_force_steps(Report& report);

}  // namespace firmtouch::bench
