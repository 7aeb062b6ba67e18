#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "surface/read/inflate.hpp"

namespace firmtouch::tools {

/// A file of a zip archive, as the central directory states it.
struct ZipEntry {
  std::string_view name;
  uint32_t method = 0, crc = 0, packed = 0, size = 0, local = 0;
};

/// The files of a zip archive. Result: a problem, or empty. Refused: zip64, several disks.
std::string list_zip(std::string_view bytes, std::vector<ZipEntry>& entries);

/// One file, stored or deflated; its length and CRC-32 are checked.
Inflated unzip(std::string_view bytes, const ZipEntry& entry);

}  // namespace firmtouch::tools
