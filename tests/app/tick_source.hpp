#pragma once
#include <cstdint>
#include <fstream>
#include <iterator>
#include <vector>

#include "firmtouch/core/span.hpp"
#include "firmtouch/params/table.hpp"
#include "firmtouch/record/tick.hpp"

namespace firmtouch::app_test {

/// A file's bytes at an address that suits an asset.
class AssetFile {
 public:
  explicit AssetFile(const char* path) {
    std::ifstream file(path, std::ios::binary);
    const std::vector<char> all{std::istreambuf_iterator<char>(file),
                                std::istreambuf_iterator<char>()};
    count_ = static_cast<uint32_t>(all.size());
    blocks_.resize((count_ + sizeof(Block) - 1) / sizeof(Block));
    for (uint32_t i = 0; i < count_; ++i) data()[i] = static_cast<uint8_t>(all[i]);
  }
  uint8_t* data() { return reinterpret_cast<uint8_t*>(blocks_.data()); }
  core::Bytes bytes() { return {data(), count_}; }

 private:
  struct alignas(16) Block {
    uint8_t bytes[16];
  };
  std::vector<Block> blocks_;
  uint32_t count_ = 0;
};

/// Tick `i` of a hand that comes down on the cube, slides along its guide, and turns a parameter
/// meanwhile.
inline record::TickInput input_of(uint32_t i) {
  constexpr uint32_t kDown = 400;  // ticks; 45 um a tick
  record::TickInput input{};
  input.tick = i;
  input.clock_us = 0xFFFF0000u + i * 1000;  // wraps on the way
  const int32_t z = i < kDown ? 4000 - static_cast<int32_t>(i) * 9 / 2 : 2200;
  const int32_t wobble = static_cast<int32_t>(i * 7919 % 5) - 2;
  input.encoder_counts[0] = i < kDown ? wobble : static_cast<int32_t>(i - kDown) + wobble;
  input.encoder_counts[1] = 100 + wobble;
  input.encoder_counts[2] = z + wobble;
  input.flags = i >= 10 ? record::kFlagEnable : 0;
  if (i == 600) {
    input.command = 1 + params::kContactStiffness;
    input.command_value = 650.0f;
  }
  return input;
}

}  // namespace firmtouch::app_test
