#pragma once
#include <stdint.h>

// The byte stream to the host (UART, USB). Lost bytes are allowed: frames carry a CRC.
namespace firmtouch::hal {

/// Moves received bytes to `to`. Never blocks. Result: number of bytes moved, 0 if none is there.
/// Context: main loop.
uint32_t link_read(uint8_t* to, uint32_t capacity);

/// Queues bytes for sending. Never blocks. Result: number of bytes accepted, from the first on.
/// Context: main loop.
uint32_t link_write(const uint8_t* from, uint32_t count);

/// Sleeps until a byte may have arrived (WFI), or returns at once. Sleep 2 ms at most: the main
/// loop polls the enable switch and the record ring as well. Context: main loop.
void link_wait();

}  // namespace firmtouch::hal
