#include <stddef.h>
#include <stdint.h>

#include "harness/test.hpp"

// The four functions that compilers call by themselves: ours on a board, the C library's on the
// host.

extern "C" {
void* memcpy(void* __restrict to, const void* __restrict from, size_t count);
void* memmove(void* to, const void* from, size_t count);
void* memset(void* to, int value, size_t count);
int memcmp(const void* left, const void* right, size_t count);
}

namespace {

constexpr uint32_t kSize = 64;

struct Bytes {
  alignas(4) uint8_t at[kSize];
};

Bytes counted(uint32_t from) {
  Bytes bytes;
  for (uint32_t i = 0; i < kSize; ++i) bytes.at[i] = static_cast<uint8_t>(from + i);
  return bytes;
}

// Through volatile pointers, so that the compiler cannot compute the result itself.
void* (*volatile copy)(void* __restrict, const void* __restrict, size_t) = memcpy;
void* (*volatile move)(void*, const void*, size_t) = memmove;
void* (*volatile fill)(void*, int, size_t) = memset;
int (*volatile compare_bytes)(const void*, const void*, size_t) = memcmp;

}  // namespace

TEST(Memcpy_EveryAlignmentAndLength_WritesExactlyThatManyBytes) {
  for (uint32_t to = 0; to < 5; ++to) {
    for (uint32_t from = 0; from < 5; ++from) {
      for (uint32_t count = 0; count < 20; ++count) {
        Bytes out = counted(100);
        const Bytes in = counted(0);
        CHECK(copy(out.at + to, in.at + from, count) == out.at + to);
        for (uint32_t i = 0; i < kSize; ++i) {
          const bool inside = i >= to && i < to + count;
          CHECK_EQ(out.at[i], inside ? in.at[i - to + from] : 100 + i);
        }
      }
    }
  }
}

TEST(Memmove_Overlapping_IsCorrectInBothDirections) {
  for (uint32_t to = 0; to < 12; ++to) {
    for (uint32_t count = 0; count < 20; ++count) {
      constexpr uint32_t kFrom = 6;
      Bytes bytes = counted(0);
      CHECK(move(bytes.at + to, bytes.at + kFrom, count) == bytes.at + to);
      for (uint32_t i = 0; i < kSize; ++i) {
        const bool inside = i >= to && i < to + count;
        CHECK_EQ(bytes.at[i], inside ? i - to + kFrom : i);
      }
    }
  }
}

TEST(Memset_WritesLowByte_AndNothingElse) {
  for (uint32_t to = 0; to < 5; ++to) {
    for (uint32_t count = 0; count < 20; ++count) {
      Bytes bytes = counted(0);
      CHECK(fill(bytes.at + to, 0x1A5, count) == bytes.at + to);
      for (uint32_t i = 0; i < kSize; ++i) {
        CHECK_EQ(bytes.at[i], i >= to && i < to + count ? 0xA5u : i);
      }
    }
  }
}

TEST(Memcmp_OrdersByFirstDifferentByte_Unsigned) {
  const uint8_t low[] = {1, 2, 0x7F, 9};
  const uint8_t high[] = {1, 2, 0x80, 0};
  CHECK_LT(compare_bytes(low, high, 4), 0);
  CHECK_GT(compare_bytes(high, low, 4), 0);
  CHECK_EQ(compare_bytes(low, high, 2), 0);
  CHECK_EQ(compare_bytes(low, high, 0), 0);
}
