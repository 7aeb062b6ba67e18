// Each rule of the container, tripped alone: one thing is wrong, every CRC but the one under test
// fits.
#include "harness/rules.hpp"
#include "asset/small_file.hpp"
#include "firmtouch/asset/opening.hpp"

namespace {

using firmtouch::asset::Container;
using firmtouch::asset_test::SmallFile;
using firmtouch::core::Bytes;
using firmtouch::core::Verdict;

constexpr uint32_t kSecond = 80, kThird = 128;  // entries
constexpr uint32_t kOffset = 4, kBytes = 8, kCrc = 12, kName = 16;
constexpr uint32_t kData = SmallFile::kData;

Verdict verdict_of(Bytes bytes) { return firmtouch::test::verdict_of<Container>(bytes); }

void expect(const SmallFile& file, uint32_t rule, uint32_t element = 0) {
  const Verdict verdict = verdict_of(file.all());
  CHECK_EQ(verdict.rule, rule);
  CHECK_EQ(verdict.element, element);
}

// A field of the third section's entry is wrong.
void expect_third(uint32_t field, uint32_t value, uint32_t rule) {
  SmallFile file;
  file.word(kThird + field, value);
  file.repair();
  expect(file, rule, 2);
}

// The third section is an origin, (x_m, -2.5, 0).
SmallFile with_origin(float x_m) {
  SmallFile file;
  file.word(kThird, firmtouch::asset::kOriginSection);
  file.word(kThird + kBytes, 12);
  const float xyzw[4] = {x_m, -2.5f, 0.0f, 0.0f};
  __builtin_memcpy(file.bytes + kData + 48, xyzw, sizeof xyzw);
  file.repair();
  return file;
}

}  // namespace

TEST(UnchangedFile_Passes) { expect(SmallFile(), 0); }

TEST(Rule1_RejectsMisalignedBase) {
  SmallFile file;
  for (uint32_t shift = 1; shift < 16; ++shift) {
    file = SmallFile();
    __builtin_memmove(file.bytes + shift, file.bytes, SmallFile::kTotal);
    CHECK_EQ(verdict_of({file.bytes + shift, SmallFile::kTotal}).rule,
             firmtouch::asset::kRuleAlignment);
  }
}

TEST(Rule2_RejectsLessThanAHeader) {
  SmallFile file;
  for (uint32_t size = 0; size < 32; ++size)
    CHECK_EQ(verdict_of({file.bytes, size}).rule, firmtouch::asset::kRuleTooShort);
  CHECK_EQ(verdict_of({}).rule, firmtouch::asset::kRuleTooShort);
}

TEST(Rule3_RejectsOtherMagic) {
  SmallFile file;
  file.word(0, 0x1A415447u);
  file.repair();
  expect(file, firmtouch::asset::kRuleMagic);
}

TEST(Rule4_RejectsOtherByteOrder) {
  SmallFile file;
  file.word(4, 0x04030201u);
  file.repair();
  expect(file, firmtouch::asset::kRuleByteOrder);
}

TEST(Rule5_RejectsOtherMajorVersion) {
  SmallFile file;
  static const uint32_t majors[] = {0u, 2u, 0xFFFFu};
  for (const uint32_t major : majors) {
    file.word(8, major);
    file.repair();
    expect(file, firmtouch::asset::kRuleMajor);
  }
}

TEST(LaterMinorVersion_Passes) {
  SmallFile file;
  file.word(8, 1u | (9u << 16));
  file.repair();
  expect(file, 0);
}

TEST(Rule6_RejectsWrongHeaderCrc) {
  SmallFile file;
  file.word(28, file.word(28) ^ 1u);
  expect(file, firmtouch::asset::kRuleHeaderCrc);
}

TEST(Rule7_RejectsNonzeroReservedWord) {
  SmallFile file;
  file.word(24, 1);
  file.repair();
  expect(file, firmtouch::asset::kRuleReserved);
}

TEST(Rule8_RejectsTruncatedFile) {
  SmallFile file;
  for (file.size = 32; file.size < SmallFile::kTotal; ++file.size)
    expect(file, firmtouch::asset::kRuleTruncated);
}

TEST(Rule9_RejectsExtendedFile) {
  SmallFile file;
  for (file.size = SmallFile::kTotal + 1; file.size <= SmallFile::kTotal + 64; ++file.size) {
    expect(file, firmtouch::asset::kRuleExtended);
  }
}

TEST(Rule10_RejectsLengthNotMultipleOf16) {
  SmallFile file;
  file.size = SmallFile::kTotal + 8;
  file.word(12, file.size);
  file.repair();
  expect(file, firmtouch::asset::kRuleTotalBytes);
}

TEST(Rule11_RejectsTableBeyondFile) {
  SmallFile file;
  static const uint32_t counts[] = {5u, 0x05555556u, 0xFFFFFFFFu};
  for (const uint32_t count : counts) {  // 48 times the second wraps to 32
    file.word(16, count);
    file.repair_header();
    expect(file, firmtouch::asset::kRuleTableSize);
  }
}

TEST(Rule12_RejectsWrongTableCrc) {
  SmallFile file;
  file.word(20, file.word(20) ^ 0x80000000u);
  file.repair_header();
  expect(file, firmtouch::asset::kRuleTableCrc);
}

TEST(Rule13_RejectsEmptyName) {
  SmallFile file;
  file.entry(0, 0x1001, "", kData, 5);
  file.repair();
  expect(file, firmtouch::asset::kRuleNameEmpty, 0);
}

TEST(Rule14_RejectsUnterminatedName) {
  SmallFile file;
  __builtin_memset(file.bytes + kThird + kName, 'x', 32);
  file.repair();
  expect(file, firmtouch::asset::kRuleNameEnd, 2);
}

TEST(Rule15_RejectsBytesAfterName) {
  SmallFile file;
  file.bytes[kSecond + kName + 31] = 'x';
  file.repair();
  expect(file, firmtouch::asset::kRuleNamePadding, 1);
}

TEST(Rule16_RejectsControlCharacters_AcceptsUtf8) {
  SmallFile file;
  static const uint8_t letters[] = {1, 10, 0x1F, 0x7F};
  for (const uint8_t letter : letters) {
    file.bytes[kThird + kName + 1] = letter;
    file.repair();
    expect(file, firmtouch::asset::kRuleNameControl, 2);
  }
  file.bytes[kThird + kName] = 0xC3;
  file.bytes[kThird + kName + 1] = 0xA4;
  file.repair();
  expect(file, 0);
}

TEST(Rule17_RejectsEntriesOutOfOrder) {
  SmallFile by_name;
  by_name.entry(2, 0x1001, "ball", kData + 48, 16);
  by_name.repair();
  expect(by_name, firmtouch::asset::kRuleEntryOrder, 2);
  SmallFile by_type;
  by_type.word(kSecond, 0x1000);
  by_type.repair();
  expect(by_type, firmtouch::asset::kRuleEntryOrder, 1);
}

TEST(Rule18_RejectsDuplicateNameAndType) {
  SmallFile file;
  file.word(kSecond, 0x1001);
  file.repair();
  expect(file, firmtouch::asset::kRuleEntryTwice, 1);
}

TEST(Rule19_RejectsEmptySection) {
  SmallFile file;
  file.word(kThird + kBytes, 0);
  file.repair();
  expect(file, firmtouch::asset::kRuleSectionEmpty, 2);
}

TEST(Rule20_RejectsUnalignedSection) {
  SmallFile file;
  file.word(kSecond + kOffset, kData + 20);
  file.repair();
  expect(file, firmtouch::asset::kRuleSectionAlignment, 1);
}

TEST(Rule21_RejectsOverlappingSection) {
  const uint32_t offsets[] = {0, 32, kData, kData + 16};  // header, table, first, second section
  for (const uint32_t offset : offsets)
    expect_third(kOffset, offset, firmtouch::asset::kRuleSectionOverlap);
}

TEST(Rule22_RejectsGapBetweenSections) {
  const uint32_t values[] = {kData + 64, 0xFFFFFFF0u};
  for (const uint32_t value : values)
    expect_third(kOffset, value, firmtouch::asset::kRuleSectionGap);
}

TEST(Rule23_RejectsSectionBeyondFile) {
  const uint32_t values[] = {17u, 0xFFFFFFFFu, 0xFFFFFF00u};
  for (const uint32_t value : values)
    expect_third(kBytes, value, firmtouch::asset::kRuleSectionOutside);
}

TEST(Rule24_RejectsBytesAfterLastSection) {
  SmallFile file;
  file.size = SmallFile::kTotal + 16;
  file.word(12, file.size);
  file.repair();
  expect(file, firmtouch::asset::kRuleTrailingBytes, 3);
}

TEST(Rule25_RejectsWrongSectionCrc) {
  SmallFile file;
  file.word(kSecond + kCrc, file.word(kSecond + kCrc) ^ 4u);
  file.repair_table();
  file.repair_header();
  expect(file, firmtouch::asset::kRuleSectionCrc, 1);
}

TEST(Rule26_RejectsNonzeroPadding) {
  SmallFile file;
  for (uint32_t at = kData + 5; at < kData + 16; ++at) {
    file.bytes[at] = 1;
    expect(file, firmtouch::asset::kRuleSectionPadding, 0);
    file.bytes[at] = 0;
  }
}

TEST(Rule27_RejectsOriginOfAnotherSize) {
  SmallFile file = with_origin(5.0f);
  file.word(kThird + kBytes, 16);
  file.repair();
  expect(file, firmtouch::asset::kRuleOriginSize, 2);
}

TEST(Rule28_RejectsOriginThatIsNoPlace) {
  static const float wrong_m[] = {1.0001e9f, -1.0001e9f, __builtin_inff(), __builtin_nanf("")};
  for (const float x_m : wrong_m) expect(with_origin(x_m), firmtouch::asset::kRuleOriginValue, 2);
  static const float sound_m[] = {0.9999e9f, -0.9999e9f};
  for (const float x_m : sound_m) expect(with_origin(x_m), 0);
}

TEST(Rule29_RejectsSecondOrigin) {
  SmallFile file = with_origin(5.0f);
  file.word(32, firmtouch::asset::kOriginSection);
  file.word(32 + kBytes, 12);
  for (uint32_t i = 0; i < 12; ++i) file.bytes[kData + i] = 0;
  file.repair();
  expect(file, firmtouch::asset::kRuleSecondOrigin, 2);
}

TEST(Origin_IsRead_AndZeroWithoutOne) {
  Container container;
  const SmallFile file = with_origin(5.0f);
  CHECK(firmtouch::asset::open(file.all(), container).ok());
  CHECK_EQ(static_cast<int>(container.origin_m().x), 5);
  CHECK_EQ(static_cast<int>(container.origin_m().y * 2), -5);
  const SmallFile plain;
  CHECK(firmtouch::asset::open(plain.all(), container).ok());
  CHECK(!(__builtin_fabsf(container.origin_m().x) > 0) && !(container.origin_m().y < 0));
}
