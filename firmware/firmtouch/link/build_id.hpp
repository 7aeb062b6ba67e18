#pragma once
#include <stdint.h>

namespace firmtouch::link {

/// First 64 bits of the SHA-256 of the firmware's sources (firmware/firmtouch), computed by the
/// build. Two programs, host or controller, have the same id if built from the same sources.
uint64_t build_id();

}  // namespace firmtouch::link
