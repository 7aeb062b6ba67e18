#pragma once
#include <stdint.h>

namespace firmtouch::hal {

constexpr int kFaultExitStatus = 70;  // exit code of an emulator's process
constexpr const char* kStackOverflowText = "Stack overflow: raise STACK_BYTES in link.ld.\n";

/// Prints `name` and eight hexadecimal digits to the console.
void print_hex(const char* name, uint32_t value);

}  // namespace firmtouch::hal
