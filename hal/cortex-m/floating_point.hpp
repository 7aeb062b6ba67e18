#pragma once

namespace firmtouch::hal {

/// Rounding to nearest and subnormal numbers, here and in every interrupt: what the asset's probes
/// prove. A boot loader may leave other modes.
void floating_point_begin();

}  // namespace firmtouch::hal
