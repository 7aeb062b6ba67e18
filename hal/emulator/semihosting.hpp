#pragma once
#include <stdint.h>

// Calls to the attached debugger or emulator (ARM "Semihosting for AArch32 and AArch64"). Without
// one, each is a HardFault: link this part (firmtouch_emulator) into images for emulators only.
namespace firmtouch::hal {

/// Opens a file on the machine that runs the emulator. Mode 1: read binary; 5: write binary.
/// Result: a file handle; -1 on failure.
int32_t semihosting_open(const char* path, uint32_t mode);
void semihosting_close(int32_t file);
/// Blocks until there is something to read. Result: bytes read; 0 at the end or on failure.
uint32_t semihosting_read(int32_t file, uint8_t* to, uint32_t capacity);
/// Result: bytes written.
uint32_t semihosting_write(int32_t file, const uint8_t* from, uint32_t count);

/// The words of `-semihosting-config arg=...`, joined by spaces. Result: false if there are none.
bool semihosting_command_line(char* text, uint32_t capacity);

}  // namespace firmtouch::hal
