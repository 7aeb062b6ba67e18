#pragma once
#include <stdint.h>

#include "cortex-m/byte_ring.hpp"

// The link of an emulated board over two FIFOs of the machine that the emulator runs on, instead of its UART: one trap a
// frame instead of one a byte, 24,000 and more round trips a second instead of 1,000 (measured with QEMU 7.2). Asked for
// with the emulator's option
//     -semihosting-config enable=on,target=native,arg=link,arg=PREFIX
// where PREFIX.in and PREFIX.out are FIFOs. The board opens PREFIX.in (to read) first, then PREFIX.out (to write): so
// must the other side. When that side closes PREFIX.in, the emulator ends. For lock-step: while the board waits for
// bytes, its clock stands still.
namespace firmtouch::hal {

/// Result: whether the link goes over files. False on hardware and where the option is not given.
bool file_link_begin();
bool file_link_is_open();
/// Blocks until bytes came, and puts them into `ring`.
void file_link_wait(ByteRing& ring);
uint32_t file_link_write(const uint8_t* from, uint32_t count);

}  // namespace firmtouch::hal
