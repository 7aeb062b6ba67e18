#pragma once

namespace firmtouch::hal {

/// Opens what `--link` names. Ends the process with a message where it cannot.
void link_open(const char* address);

/// Waits until every byte that link_write() took has left (a serial line's are still on their way).
void link_drain();

}  // namespace firmtouch::hal
