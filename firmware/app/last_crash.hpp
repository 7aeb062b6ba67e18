#pragma once
#include "firmtouch/link/protocol.hpp"

// Part `crash_record`: what the run before this one left, for the console and for hosts.
namespace firmtouch::app {

/// Takes the record over from the board and prints it. Start-up.
void take_crash();

/// For a host that requests it, as often as it does. Main loop.
const link::CrashReply& last_crash();

}  // namespace firmtouch::app
