#pragma once
#include "firmtouch/link/protocol.hpp"

namespace firmtouch::app {

/// One row of the controller's description of itself: a host or a page of another version reads
/// records and sets parameters by it. Main loop only.
link::Description describe_row(const link::Describe& wanted);

}  // namespace firmtouch::app
