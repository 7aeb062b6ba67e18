#pragma once

namespace firmtouch::hal {

/// Enables the caches of a Cortex-M7, unless a boot loader did: dropping them then loses writes.
void caches_begin();

}  // namespace firmtouch::hal
