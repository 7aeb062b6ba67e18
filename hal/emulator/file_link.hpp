#pragma once
#include <stdint.h>

#include "parts/byte_ring.hpp"

// The link of an emulated board over two host FIFOs instead of its UART: one trap a frame instead
// of one a byte, 24,000 round trips a second instead of 1,000 (QEMU 7.2). QEMU's option:
//     -semihosting-config enable=on,target=native,arg=link,arg=PREFIX
// Both sides open PREFIX.in (host to board) first, then PREFIX.out. When the host closes PREFIX.in,
// the emulator exits. The board's clock stands still while it waits for bytes (lock-step).
namespace firmtouch::hal {

/// Opens the FIFOs. Result: false on hardware and without the option above.
bool file_link_begin();
bool file_link_is_open();
/// If `ring` is empty: blocks until bytes arrive and pushes them into it.
void file_link_wait(ByteRing& ring);
/// Result: bytes written.
uint32_t file_link_write(const uint8_t* from, uint32_t count);

}  // namespace firmtouch::hal
