#pragma once
#include <stdint.h>

#include "firmtouch/asset/layout.hpp"
#include "firmtouch/core/crc32.hpp"

// A small asset file written by hand, without the baker, so that the decoder has a second opinion.
// No heap: it runs on the controller too.
namespace firmtouch::asset_test {

struct SmallFile {
  static constexpr uint32_t kSections = 3;
  static constexpr uint32_t kData = 32 + kSections * 48;
  static constexpr uint32_t kTotal = kData + 16 + 32 + 16;
  // One unit more than the file, so that tests can shift it and extend it.
  alignas(16) uint8_t bytes[kTotal + 64];
  uint32_t size = kTotal;

  SmallFile() {
    __builtin_memset(bytes, 0, sizeof(bytes));
    word(0, 0x1A415446u);
    word(4, 0x01020304u);
    word(8, 1);
    word(12, kTotal);
    word(16, kSections);
    entry(0, 0x1001, "bump", kData, 5);
    entry(1, 0x7777, "bump", kData + 16, 32);
    entry(2, 0x1001, "wall", kData + 48, 16);
    for (uint32_t i = 0; i < 5; ++i) bytes[kData + i] = static_cast<uint8_t>(0xA0 + i);
    for (uint32_t i = 0; i < 32; ++i) bytes[kData + 16 + i] = static_cast<uint8_t>(i * 7);
    for (uint32_t i = 0; i < 16; ++i) bytes[kData + 48 + i] = static_cast<uint8_t>(255 - i);
    repair();
  }

  void word(uint32_t at, uint32_t value) {
    for (uint32_t k = 0; k < 4; ++k) bytes[at + k] = static_cast<uint8_t>(value >> (8 * k));
  }
  uint32_t word(uint32_t at) const {
    uint32_t value = 0;
    for (uint32_t k = 0; k < 4; ++k) value |= static_cast<uint32_t>(bytes[at + k]) << (8 * k);
    return value;
  }
  uint32_t entry_at(uint32_t i) const { return 32 + 48 * i; }
  void entry(uint32_t i, uint32_t type, const char* name, uint32_t offset, uint32_t count) {
    const uint32_t at = entry_at(i);
    word(at, type);
    word(at + 4, offset);
    word(at + 8, count);
    __builtin_memset(bytes + at + 16, 0, 32);
    for (uint32_t k = 0; name[k] != 0; ++k) bytes[at + 16 + k] = static_cast<uint8_t>(name[k]);
  }
  void repair() {
    for (uint32_t i = 0; i < kSections; ++i) repair_section(i);
    repair_table();
    repair_header();
  }
  void repair_section(uint32_t i) {
    const uint32_t offset = word(entry_at(i) + 4);
    const uint32_t count = word(entry_at(i) + 8);
    if (offset <= size && count <= size - offset) {
      word(entry_at(i) + 12, core::crc32({bytes + offset, count}));
    }
  }
  void repair_table() { word(20, core::crc32({bytes + 32, kSections * 48})); }
  void repair_header() { word(28, core::crc32({bytes, 28})); }

  core::Bytes all() const { return {bytes, size}; }
};

}  // namespace firmtouch::asset_test
