#pragma once
#include <cstddef>

#include "host_sim/plant/vec.hpp"

namespace firmtouch::host_sim {

/// Root mean square of a force within 50 to 500 Hz, all three components together, by a Fourier
/// transform with a Hann window of the last power of two of the `count` samples.
/// Pre: at least 2 samples.
double buzz_N(const Vec* force_N, size_t count, double rate_Hz);

}  // namespace firmtouch::host_sim
