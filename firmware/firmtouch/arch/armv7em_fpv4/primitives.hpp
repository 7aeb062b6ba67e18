#pragma once
// Armv7E-M with an FPv4 unit: Cortex-M4F. For the library's own translation units.

#include "firmtouch/arch/armv7em_fpv4/common.hpp"

namespace firmtouch::math {

using portable::larger;
using portable::smaller;

}  // namespace firmtouch::math
