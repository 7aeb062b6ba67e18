#pragma once
#include "firmtouch/link/protocol.hpp"

namespace firmtouch::app {

/// A row of what the controller tells about itself: so a host or a page of another version can read
/// its records and offer its parameters. Main loop only.
link::Description describe_row(const link::Describe& wanted);

}  // namespace firmtouch::app
