#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace firmtouch::tools {

/// Depths of a height map, from 0 at white to 255 at black, row by row from the top.
struct HeightMap {
  uint32_t side = 0;
  std::vector<uint8_t> samples;
};

/// Reads a PGM picture (P2 or P5) of 8 bits. Throws Refused with the path: it cannot be read, is
/// no such picture, is cut short, or is not square with a side of 4, 8, 16, 32 or 64.
HeightMap read_height_map(const std::string& path);

}  // namespace firmtouch::tools
