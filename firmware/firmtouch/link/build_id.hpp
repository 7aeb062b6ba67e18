#pragma once
#include <stdint.h>

namespace firmtouch::link {

/// First 64 bits of the SHA-256 over the firmware's sources (firmware/firmtouch), computed by the
/// build: equal in two programs, host or controller, exactly if both were built from the same text.
uint64_t build_id();

}  // namespace firmtouch::link
