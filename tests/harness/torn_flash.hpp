#pragma once
#include <cstdint>
#include <vector>

#include "firmtouch/core/span.hpp"
#include "harness/random.hpp"
#include "harness/test.hpp"

namespace firmtouch::test {

struct PowerCut {};

enum class Cut { kNone, kBefore, kTorn, kBehind };

// Two areas of NOR flash, one behind the other: erase sets a sector's bits, program clears bits, a
// unit at a time. A torn operation leaves any mixture of old and new bits.
class TornFlash {
 public:
  TornFlash(uint32_t area_bytes, uint32_t sector_bytes, uint32_t unit_bytes)
      : blocks_(2 * area_bytes / sizeof(Block)),
        area_(area_bytes),
        sector_(sector_bytes),
        unit_(unit_bytes) {}
  void cut_at(uint32_t operation, Cut cut) { wait_ = operation, cut_ = cut; }
  uint32_t operations() const { return operations_; }

  struct View {
    core::Bytes area[2];
  };
  View view() const {
    const uint8_t* const first = blocks_.data()->bytes;
    return {{{first, area_}, {first + area_, area_}}};
  }
  uint8_t* bytes(uint32_t area) { return blocks_.data()->bytes + area * area_; }
  void fill(Xorshift& random) {
    for (uint32_t i = 0; i < 2 * area_; ++i) bytes(0)[i] = static_cast<uint8_t>(random());
  }

  void erase(uint32_t area, uint32_t offset = 0) {
    const std::vector<uint8_t> blank(sector_, 0xFF);
    CHECK_EQ(offset % sector_, 0u);
    apply(bytes(area) + offset, blank.data(), sector_);
  }
  void program(uint32_t area, uint32_t offset, core::Bytes from) {
    CHECK_EQ(offset % 32, 0u);
    for (uint32_t at = 0; at < from.size();) {
      const uint32_t in_unit = unit_ - (offset + at) % unit_;
      const uint32_t count = in_unit < from.size() - at ? in_unit : from.size() - at;
      uint8_t* const to = bytes(area) + offset + at;
      for (uint32_t i = 0; i < count; ++i) CHECK_EQ(to[i], 0xFF);  // never twice
      apply(to, from.data() + at, count);
      at += count;
    }
  }

 private:
  struct alignas(32) Block {
    uint8_t bytes[32] = {};
  };
  void apply(uint8_t* to, const uint8_t* after, uint32_t count) {
    ++operations_;
    const bool is_cut = cut_ != Cut::kNone && wait_-- == 0;
    if (is_cut && cut_ == Cut::kBefore) throw PowerCut{};
    for (uint32_t i = 0; i < count; ++i) {
      const uint8_t mix = is_cut && cut_ == Cut::kTorn ? static_cast<uint8_t>(random_()) : 0xFF;
      to[i] = static_cast<uint8_t>((to[i] & ~mix) | (after[i] & mix));
    }
    if (is_cut) throw PowerCut{};
  }

  std::vector<Block> blocks_;
  uint32_t area_ = 0, sector_ = 0, unit_ = 0, operations_ = 0, wait_ = 0;
  Cut cut_ = Cut::kNone;
  Xorshift random_{7};
};

}  // namespace firmtouch::test
