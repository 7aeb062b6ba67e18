#include "asset/small_file.hpp"
#include "firmtouch/asset/opening.hpp"
#include "harness/test.hpp"

namespace {

using namespace firmtouch::asset;  // NOLINT: a test file
using firmtouch::asset_test::SmallFile;
using firmtouch::core::Bytes;

Container opened(const SmallFile& file) {
  Container container;
  CHECK(firmtouch::asset::open(file.all(), container).ok());
  return container;
}

}  // namespace

TEST(Container_FindsSectionByTypeAndName_InPlace) {
  const SmallFile file;
  const Container container = opened(file);
  const Bytes bump = container.find(0x1001, "bump");
  CHECK(bump.data() == file.bytes + SmallFile::kData);
  CHECK_EQ(bump.size(), 5u);
  CHECK_EQ(container.find(0x7777, "bump").size(), 32u);
  const Bytes wall = container.find(0x1001, "wall");
  CHECK_EQ(wall.size(), 16u);
  CHECK_EQ(wall[0], 255);
}

TEST(Container_MissingSection_IsNotFound) {
  const SmallFile file;
  const Container container = opened(file);
  static const char* const names[] = {
      "",
      "bum",
      "bumpy",
      "a",
      "zebra",
      "WALL",
      "a name that is longer than any name that an entry of the table holds"};
  for (const char* name : names) {
    CHECK(container.find(0x1001, name).empty());
  }
  CHECK(container.find(0x1002, "bump").empty());
  CHECK(container.find(0x7777, "wall").empty());
  CHECK(container.find(0x1000, "wall").empty());
}

TEST(Container_NextOfType_IgnoresNames) {
  const SmallFile file;
  const Container container = opened(file);
  CHECK_EQ(container.next_of_type(0x1001), 0u);
  CHECK_EQ(container.next_of_type(0x1001, 1), 2u);
  CHECK_EQ(container.next_of_type(0x1001, 3), kNoSection);
  CHECK_EQ(container.next_of_type(0x2001), kNoSection);
  CHECK(__builtin_memcmp(container.name(2), "wall", 5) == 0);
  CHECK_EQ(container.section(2).size(), 16u);
}

TEST(Container_Closed_IsEmpty) {
  const Container container;
  CHECK(!container.is_open());
  CHECK_EQ(container.section_count(), 0u);
  CHECK(container.find(0x1001, "bump").empty());
  CHECK_EQ(container.next_of_type(0x1001), kNoSection);
  CHECK_EQ(container.crc(), 0u);
}

TEST(Opening_AnySliceSize_SameVerdict) {
  SmallFile file;
  for (uint32_t broken = 0; broken < 2; ++broken) {
    if (broken == 1) file.bytes[SmallFile::kTotal - 1] ^= 1;
    static const uint32_t budgets[] = {0u, 1u, 3u, 16u, 100u, 0xFFFFFFFFu};
    for (const uint32_t budget : budgets) {
      Opening opening(file.all());
      uint32_t slices = 0;
      while (!opening.done() && slices < 1000) {
        CHECK(!opening.view().is_open());
        opening.work(budget);
        ++slices;
      }
      CHECK(opening.done());
      CHECK_EQ(opening.verdict().rule, broken == 1 ? 25 : 0);
      CHECK_EQ(opening.view().is_open(), broken == 0);
      if (budget <= 1) CHECK_GE(slices, 5u);
    }
  }
}

TEST(Opening_NoSections_Passes) {
  SmallFile file;
  file.size = 32;
  file.word(12, 32);
  file.word(16, 0);
  file.word(20, 0);  // the CRC of no bytes
  file.repair_header();
  Container container;
  CHECK(firmtouch::asset::open(file.all(), container).ok());
  CHECK(container.is_open());
  CHECK_EQ(container.section_count(), 0u);
}

TEST(StatedBytes_LongerRegion_GivesAssetLength) {
  SmallFile file;
  CHECK_EQ(firmtouch::asset::stated_bytes({file.bytes, sizeof(file.bytes)}), SmallFile::kTotal);
  CHECK_EQ(firmtouch::asset::stated_bytes({file.bytes, SmallFile::kTotal - 1}), 0u);
  CHECK_EQ(firmtouch::asset::stated_bytes({file.bytes, 31}), 0u);
  file.bytes[0] = 0xFF;  // erased flash
  CHECK_EQ(firmtouch::asset::stated_bytes(file.all()), 0u);
}

TEST(Opening_AnyFlippedBitOrLength_IsRejected) {
  SmallFile file;
  Container container;
  for (uint32_t bit = 0; bit < SmallFile::kTotal * 8; ++bit) {
    file.bytes[bit / 8] ^= static_cast<uint8_t>(1u << (bit % 8));
    if (firmtouch::asset::open(file.all(), container).ok()) firmtouch::test::note("bit", bit);
    CHECK(!container.is_open());
    file.bytes[bit / 8] ^= static_cast<uint8_t>(1u << (bit % 8));
  }
  CHECK_EQ(opened(file).crc(), file.word(28));
}
