#pragma once

namespace firmtouch::hal {

/// An emulator's virtual time runs as fast as it can. Waits so that what a person looks at does not.
/// For a demonstration's servo interrupt, once a tick; nothing else calls it.
void pace_tick();

}  // namespace firmtouch::hal
