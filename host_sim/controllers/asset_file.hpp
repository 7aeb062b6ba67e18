#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "firmtouch/core/span.hpp"

namespace firmtouch::host_sim {

/// An asset file in memory, 16-byte aligned as the firmware requires.
class AssetFile {
 public:
  /// Throws Refused with the path if the file cannot be read, or is none.
  explicit AssetFile(const std::string& path);

  core::Bytes bytes() const;
  const std::string& path() const { return path_; }

 private:
  struct alignas(16) Block {
    uint8_t bytes[16];
  };
  std::string path_;
  std::vector<Block> blocks_;
  uint32_t size_ = 0;
};

}  // namespace firmtouch::host_sim
