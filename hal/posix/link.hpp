#pragma once

namespace firmtouch::hal {

/// Opens the link that `--link` names. On failure, ends the process with a message (status 3).
void link_open(const char* address);

/// Waits until a serial device has sent every byte that link_write() accepted.
void link_drain();

}  // namespace firmtouch::hal
