#pragma once
#include <stdint.h>

namespace firmtouch::hal {

/// Bytes to and from the host (UART, USB). Main loop only. Both return at once with the number of bytes taken.
uint32_t link_read(uint8_t* to, uint32_t capacity);
uint32_t link_write(const uint8_t* from, uint32_t count);
/// Sleeps until something may have arrived (WFI), or returns at once.
void link_wait();

}  // namespace firmtouch::hal
