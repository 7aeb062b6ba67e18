#pragma once
#include "bench/report.hpp"

namespace firmtouch::bench {

/// The greatest change of a guide's force from one tick to the next, along straight and cubic
/// pieces.
void run_force_steps(Report& report);

}  // namespace firmtouch::bench
