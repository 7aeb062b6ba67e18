#pragma once

namespace firmtouch::hal {

struct Options {
  // unix:PATH, tcp:HOST:PORT, listen:PATH, fd:N, pty, or a serial device.
  const char* link = nullptr;
  const char* asset = nullptr;       // path of an .fta file
  const char* parameters = nullptr;  // file that stands for the flash of saved parameters
  const char* slots = nullptr;       // and for that of loaded assets
};

/// The command line, parsed once. Ends the process after a usage error (status 2) or --help (0).
const Options& options();

}  // namespace firmtouch::hal
