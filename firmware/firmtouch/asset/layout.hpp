#pragma once
#include <stddef.h>
#include <stdint.h>

// Byte layout of an asset file (specification: tools/FORMAT.md): header, section table, sections in
// the table's order, each at a multiple of 16 bytes, padded with zeros. Little-endian, offsets
// only.

namespace firmtouch::asset {

constexpr uint32_t kMagic = 0x1A415446u;      // the bytes 'F' 'T' 'A' 0x1A
constexpr uint32_t kByteOrder = 0x01020304u;  // as a little-endian machine reads 04 03 02 01
constexpr uint16_t kMajor = 1;                // other majors are rejected
constexpr uint16_t kMinor = 0;                // a later minor only adds sections, which are skipped

constexpr uint32_t kAlignment = 16;  // of the file's first byte and of every section
constexpr uint32_t kNameBytes = 32;  // up to 31 bytes of UTF-8 and at least one zero

// Section types. Each module owns a range: 0x0001.. this container, 0x1001.. mesh/layout.hpp,
// 0x2001.. curve/layout.hpp. A reader skips unknown types.
constexpr uint32_t kBoundsSection = 0x0001;      // text: bounds that the baker measured and proved
constexpr uint32_t kProvenanceSection = 0x0002;  // text: source, hash, options, tool version
constexpr uint32_t kOriginSection = 0x0003;      // f32[3]: what stored coordinates count from

constexpr float kMaxOrigin_m = 1e9f;  // |x| + |y| + |z|

struct Header {
  uint32_t magic;
  uint32_t byte_order;
  uint16_t major;
  uint16_t minor;
  uint32_t total_bytes;    // of the whole file, a multiple of 16
  uint32_t section_count;  // entries of the table, which follows the header
  uint32_t table_crc;      // of the entries
  uint32_t reserved;       // 0
  uint32_t header_crc;     // of the 28 bytes before; identifies the asset
};
static_assert(sizeof(Header) == 32 && alignof(Header) == 4);
static_assert(offsetof(Header, total_bytes) == 12 && offsetof(Header, header_crc) == 28);

/// One section. Entries are in strictly increasing order of (name as unsigned bytes, type).
struct Entry {
  uint32_t type;
  uint32_t offset;  // from the file's first byte
  uint32_t bytes;   // at least 1, without the padding
  uint32_t crc;     // of those bytes
  char name[kNameBytes];
};
static_assert(sizeof(Entry) == 48 && offsetof(Entry, name) == 16);
static_assert(sizeof(Header) % kAlignment == 0 && sizeof(Entry) % kAlignment == 0);

/// Why opening rejects; the numbers never change. tools/FORMAT.md prints the same text.
enum Rule : uint16_t {
  // The address of the file's first byte is not a multiple of 16.
  kRuleAlignment = 1,
  // The file is shorter than a header.
  kRuleTooShort = 2,
  // The magic is another.
  kRuleMagic = 3,
  // The byte order is another.
  kRuleByteOrder = 4,
  // The major version is not 1.
  kRuleMajor = 5,
  // The header does not match its CRC.
  kRuleHeaderCrc = 6,
  // A reserved word is not 0.
  kRuleReserved = 7,
  // The file is truncated: total_bytes exceeds its length.
  kRuleTruncated = 8,
  // The file is extended: total_bytes is less than its length.
  kRuleExtended = 9,
  // total_bytes is not a multiple of 16.
  kRuleTotalBytes = 10,
  // The table does not fit into the file.
  kRuleTableSize = 11,
  // The table does not match its CRC.
  kRuleTableCrc = 12,
  // A name is empty.
  kRuleNameEmpty = 13,
  // A name does not end with a zero.
  kRuleNameEnd = 14,
  // A byte behind the end of a name is not zero.
  kRuleNamePadding = 15,
  // A name contains a control character (below 0x20, or 0x7F).
  kRuleNameControl = 16,
  // An entry must stand before the previous one.
  kRuleEntryOrder = 17,
  // Two entries have the same name and type.
  kRuleEntryTwice = 18,
  // A section is empty.
  kRuleSectionEmpty = 19,
  // A section does not begin at a multiple of 16.
  kRuleSectionAlignment = 20,
  // A section begins before the end of the previous one (the first: of the table).
  kRuleSectionOverlap = 21,
  // A section begins later than it must.
  kRuleSectionGap = 22,
  // A section extends beyond the file.
  kRuleSectionOutside = 23,
  // Bytes follow the padding of the last section.
  kRuleTrailingBytes = 24,
  // A section does not match its CRC.
  kRuleSectionCrc = 25,
  // The padding behind a section is not zero.
  kRuleSectionPadding = 26,
  // An origin is not 12 bytes.
  kRuleOriginSize = 27,
  // The sizes of an origin's coordinates add up to more than 1e9 m, or one is NaN.
  kRuleOriginValue = 28,
  // There are two origins.
  kRuleSecondOrigin = 29,
};

}  // namespace firmtouch::asset
