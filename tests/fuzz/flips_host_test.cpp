// An asset with every section type, damaged by a flipped bit, a truncation or a special word. With
// the old CRCs it is always rejected. With repaired CRCs a numbered rule rejects it, or every
// answer stays in range, finite and within its budget.
#include <cstring>
#include <set>

#include "bake/asset/asset_writer.hpp"
#include "firmtouch/asset/opening.hpp"
#include "firmtouch/curve/layout.hpp"
#include "firmtouch/field/layout.hpp"
#include "firmtouch/mesh/layout.hpp"
#include "fuzz/victim.hpp"
#include "harness/long.hpp"
#include "harness/test.hpp"
#include "surface/random.hpp"

// Vectors pass between instrumented and plain code, so their unused capacity is not checked.
extern "C" const char* __asan_default_options();
extern "C" const char* __asan_default_options() { return "detect_container_overflow=0"; }

namespace {

using namespace firmtouch;

using test::is_long;

const std::vector<uint8_t>& victim() {
  static const std::vector<uint8_t> bytes = fuzz::make_victim();
  return bytes;
}

asset::Container opened_victim() {
  asset::Container container;
  CHECK(asset::open({victim().data(), static_cast<uint32_t>(victim().size())}, container).ok());
  return container;
}

void flip(std::vector<uint8_t>& file, size_t bit) {
  file[bit / 8] = static_cast<uint8_t>(file[bit / 8] ^ (1u << (bit % 8)));
}

// The asset whose section holds this byte of the victim; nullptr: the header, the table or padding.
const char* asset_at(const asset::Container& container, size_t byte) {
  for (uint32_t i = 0; i < container.section_count(); ++i) {
    const core::Bytes section = container.section(i);
    const size_t begin = static_cast<size_t>(section.data() - victim().data());
    if (byte >= begin && byte < begin + section.size()) return container.name(i);
  }
  return nullptr;
}

// Two bits of every byte, `first` and the next: a quarter of all, to run in parallel. The daily
// suite flips one of them, in turn, and runs only the queries of the changed asset.
void flip_repaired(size_t first) {
  const asset::Container whole = opened_victim();
  std::vector<uint8_t> file;
  int64_t refused = 0, harmless = 0, flips = 0;
  for (size_t bit = first; bit < victim().size() * 8; bit += bit % 2 == 0 ? 1u : 7u) {
    if (!is_long() && bit % 2 != bit / 8 % 2) continue;
    ++flips;
    file = victim();
    flip(file, bit);
    tools::repair_crcs(file);
    test::note("bit", static_cast<int64_t>(bit));
    const char* const only = is_long() ? nullptr : asset_at(whole, bit / 8);
    ++(fuzz::exercise(file, only).ok() ? harmless : refused);
  }
  CHECK_EQ(flips, static_cast<int64_t>(victim().size()) * (is_long() ? 2 : 1));
  CHECK_EQ(refused + harmless, flips);
  // Text, probes and the low bits of normals are harmless; indices, boxes, trees and lengths are
  // not.
  CHECK_GE(refused, flips / 8);
  CHECK_GE(harmless, 1);
}

}  // namespace

TEST(Victim_HasEverySectionType_AndRuns) {
  CHECK_LE(victim().size(), 65536u);
  CHECK(fuzz::exercise(victim()).ok());
  const asset::Container container = opened_victim();
  std::set<uint32_t> types;
  for (uint32_t i = 0; i < container.section_count(); ++i) types.insert(container.type(i));
  for (uint32_t type = asset::kBoundsSection; type <= asset::kOriginSection; ++type)
    CHECK_EQ(types.count(type), 1u);
  for (uint32_t type = mesh::kHeadSection; type <= mesh::kLeafBoxesSection; ++type)
    CHECK_EQ(
        types.count(type),
        type == 0x1008u || type == 0x100Cu || type == 0x100Du ? 0u : 1u);  // of earlier layouts
  for (uint32_t type = field::kHeadSection; type <= field::kSeedsSection; ++type)
    CHECK_EQ(types.count(type), 1u);
  for (uint32_t type = curve::kHeadSection; type <= curve::kRadiiSection; ++type)
    CHECK_EQ(types.count(type), type == 0x2004u || type == 0x2009u ? 0u : 1u);  // of earlier ones
}

TEST(FlippedBit_IsRejected) {
  std::vector<uint8_t> file = victim();
  for (size_t bit = 0; bit < file.size() * 8; ++bit) {
    flip(file, bit);
    test::note("bit", static_cast<int64_t>(bit));
    CHECK(!fuzz::exercise(file).ok());
    flip(file, bit);
  }
}

TEST(Truncation_IsRejected_WithRepairedCrcsToo) {
  for (size_t size = 0; size < victim().size(); ++size) {
    std::vector<uint8_t> file(victim().begin(),
                              victim().begin() + static_cast<std::ptrdiff_t>(size));
    CHECK(!fuzz::exercise(file).ok());
    tools::repair_crcs(file);
    CHECK(!fuzz::exercise(file).ok());
  }
}

TEST(FlippedBit_WithRepairedCrcs_IsRejectedOrHarmless) { flip_repaired(0); }
TEST(FlippedBit_WithRepairedCrcs_IsRejectedOrHarmless_Bits2And3) { flip_repaired(2); }
TEST(FlippedBit_WithRepairedCrcs_IsRejectedOrHarmless_Bits4And5) { flip_repaired(4); }
TEST(FlippedBit_WithRepairedCrcs_IsRejectedOrHarmless_Bits6And7) { flip_repaired(6); }

TEST(SpecialWord_WithRepairedCrcs_IsRejectedOrHarmless) {
  const uint32_t odd[] = {0,           1,           0xFFFFFFFFu, 0x7FFFFFFFu,
                          0x80000000u, 0x7FC00000u, 0x7F800000u, 0xFF800000u,
                          0x00000001u, 0x7F7FFFFFu, 0x3F800000u, 0xFFFFFFF0u};
  tools::Random random(20240611);
  const int cases = is_long() ? 200000 : 3000;
  std::vector<uint8_t> file;
  for (int i = 0; i < cases; ++i) {
    file = victim();
    const uint32_t words = 1 + random.below(3);
    for (uint32_t k = 0; k < words; ++k) {
      const size_t at = 4 * random.below(static_cast<uint32_t>(file.size() / 4));
      const uint32_t word =
          random.below(2) == 0 ? odd[random.below(12)] : static_cast<uint32_t>(random.next());
      std::memcpy(&file[at], &word, 4);
    }
    tools::repair_crcs(file);
    test::note("case", i);
    (void)fuzz::exercise(file);
  }
}

// Once undefined: a curve's second arc position as -0, which passes `>= 0`.
TEST(MinusZero_ForAnyWord_IsRejectedOrHarmless) {
  const asset::Container whole = opened_victim();
  std::vector<uint8_t> file;
  const uint32_t minus_zero = 0x80000000u;
  for (size_t at = 0; at + 4 <= victim().size(); at += 4) {
    file = victim();
    std::memcpy(&file[at], &minus_zero, 4);
    tools::repair_crcs(file);
    test::note("byte", static_cast<int64_t>(at));
    (void)fuzz::exercise(file, is_long() ? nullptr : asset_at(whole, at));
  }
}
