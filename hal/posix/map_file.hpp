#pragma once
#include <cstdint>

namespace firmtouch::hal {

/// Maps a file that stands for flash; it is created, or grows to `bytes`. Ends the process if it
/// cannot be opened. Result: null if `path` is null.
uint8_t* map_file(const char* path, uint32_t bytes);

}  // namespace firmtouch::hal
