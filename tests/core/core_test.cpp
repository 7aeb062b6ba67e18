// The ground floor: check sums, spans of structs, the hash that machines compare.
#include <stdint.h>

#include "firmtouch/core/bisect.hpp"
#include "firmtouch/core/bytes.hpp"
#include "firmtouch/core/crc32.hpp"
#include "firmtouch/core/hash.hpp"
#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"
#include "harness/test.hpp"

namespace core = firmtouch::core;

namespace {

constexpr uint8_t kCheck[9] = {'1', '2', '3', '4', '5', '6', '7', '8', '9'};

// One bit at a time, as the polynomial is defined.
uint32_t bitwise_crc(core::Bytes bytes) {
  uint32_t crc = 0xFFFFFFFFu;
  for (const uint8_t byte : bytes) {
    crc ^= byte;
    for (int bit = 0; bit < 8; ++bit) crc = (crc >> 1) ^ ((crc & 1u) != 0 ? 0xEDB88320u : 0u);
  }
  return ~crc;
}

struct Pair {
  uint16_t a;
  uint32_t b;
};

alignas(16) uint8_t g_bytes[256];

void fill() {
  uint32_t word = 12345;
  for (uint8_t& byte : g_bytes) {
    word = word * 1664525u + 1013904223u;
    byte = static_cast<uint8_t>(word >> 24);
  }
}

}  // namespace

TEST(Crc_GivesPublishedCheckValue) {
  CHECK_EQ(core::crc32(kCheck), 0xCBF43926u);
  CHECK_EQ(core::crc32(core::Bytes{}), 0u);
}

TEST(Crc_EqualsBitwiseDefinition_ForEveryLength) {
  fill();
  for (uint32_t n = 0; n <= sizeof g_bytes; ++n)
    CHECK_EQ(core::crc32({g_bytes, n}), bitwise_crc({g_bytes, n}));
}

TEST(Crc_ContinuesAcrossCalls) {
  fill();
  const uint32_t whole = core::crc32(g_bytes);
  for (uint32_t cut = 0; cut <= sizeof g_bytes; ++cut) {
    const core::Bytes rest(g_bytes + cut, static_cast<uint32_t>(sizeof g_bytes) - cut);
    CHECK_EQ(core::crc32(rest, core::crc32({g_bytes, cut})), whole);
  }
}

TEST(Crc_DetectsEverySingleBit) {
  fill();
  const uint32_t good = core::crc32(g_bytes);
  uint32_t missed = 0;
  for (uint32_t bit = 0; bit < 8 * sizeof g_bytes; ++bit) {
    const uint8_t mask = static_cast<uint8_t>(1u << (bit % 8));
    g_bytes[bit / 8] = static_cast<uint8_t>(g_bytes[bit / 8] ^ mask);
    if (core::crc32(g_bytes) == good) ++missed;
    g_bytes[bit / 8] = static_cast<uint8_t>(g_bytes[bit / 8] ^ mask);
  }
  CHECK_EQ(missed, 0u);
}

TEST(AsArray_Misaligned_IsEmpty) {
  for (uint32_t shift = 0; shift < 16; ++shift) {
    const core::Bytes bytes(g_bytes + shift, 64);
    CHECK_EQ(core::as_array<uint32_t>(bytes, 4).empty(), shift % alignof(uint32_t) != 0);
    CHECK_EQ(core::as_array<uint16_t>(bytes, 4).empty(), shift % alignof(uint16_t) != 0);
    CHECK_EQ(core::as_array<uint8_t>(bytes, 4).size(), 4u);
  }
}

TEST(AsArray_TooFewBytes_IsEmpty) {
  for (uint32_t bytes = 0; bytes <= 64; ++bytes) {
    const uint32_t whole = bytes / static_cast<uint32_t>(sizeof(Pair));
    for (uint32_t count = 1; count < 12; ++count) {
      CHECK_EQ(core::as_array<Pair>({g_bytes, bytes}, count).size(), count <= whole ? count : 0u);
    }
    CHECK_EQ(core::as_whole_array<Pair>({g_bytes, bytes}).size(),
             bytes % sizeof(Pair) == 0 ? whole : 0u);
  }
  // A count whose bytes overflow 32 bits must not look small.
  CHECK(core::as_array<Pair>({g_bytes, 64}, 0x20000001u).empty());
  CHECK(core::as_array<Pair>({g_bytes, 64}, UINT32_MAX).empty());
}

TEST(AsArray_ReadsInPlace) {
  fill();
  const core::Span<const uint32_t> words = core::as_array<uint32_t>(g_bytes, 2);
  CHECK_EQ(words[1], static_cast<uint32_t>(g_bytes[4]) | static_cast<uint32_t>(g_bytes[5]) << 8 |
                         static_cast<uint32_t>(g_bytes[6]) << 16 |
                         static_cast<uint32_t>(g_bytes[7]) << 24);
  CHECK(reinterpret_cast<const uint8_t*>(words.data()) == g_bytes);
}

TEST(Hash_IsFnv1aOfLittleEndianBytes) {
  core::Hash hash;
  CHECK(hash.value() == 0xCBF29CE484222325ull);
  hash.add(0x64636261u);  // "abcd"; its FNV-1a as published
  CHECK(hash.value() == 0xFC179F83EE0724DDull);
  core::Hash other;
  other.add(0x64636260u);
  CHECK(other.value() != hash.value());
}

TEST(Verdict_RuleZero_IsPassed) {
  CHECK(core::kPassed.ok());
  CHECK(!core::reject(3, 9).ok());
  CHECK_EQ(core::reject(3, 9).rule, 3u);
  CHECK_EQ(core::reject(3, 9).element, 9u);
}

TEST(LastThat_AnyCountAndBorder_IsTheIndexBeforeIt) {
  for (uint32_t count = 0; count < 40; ++count)
    for (uint32_t border = 0; border <= count; ++border) {
      uint32_t calls = 0;
      const uint32_t found = core::last_that(count, [&](uint32_t i) {
        CHECK_LT(i, count);
        ++calls;
        return i < border;
      });
      CHECK_EQ(found, border > 0 ? border - 1 : 0u);
      CHECK_LE(calls, 6u);
    }
  CHECK_EQ(core::last_that(INT32_MAX, [](uint32_t i) { return i < 0x7FFFFFF0u; }), 0x7FFFFFEFu);
}
