#pragma once

namespace firmtouch::hal {

struct Options {
  // unix:PATH, tcp:HOST:PORT, listen:PATH, fd:N, pty, or a serial device.
  const char* link = nullptr;
  const char* asset = nullptr;  // file
};

/// The command line, read once. Ends the process with a message where it makes no sense (status 2)
/// or was --help (0).
const Options& options();

}  // namespace firmtouch::hal
