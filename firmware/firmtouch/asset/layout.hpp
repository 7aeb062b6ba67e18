#pragma once
#include <stddef.h>
#include <stdint.h>

// How an asset file lies in memory, byte for byte (tools/FORMAT.md says it in words): header,
// section table, sections in the order of the table, each at a multiple of 16 bytes, zeros between
// them. Little-endian, offsets only.

namespace firmtouch::asset {

constexpr uint32_t kMagic = 0x1A415446u;      // the bytes 'F' 'T' 'A' 0x1A
constexpr uint32_t kByteOrder = 0x01020304u;  // as a little-endian machine reads 04 03 02 01
constexpr uint16_t kMajor = 1;                // another major is refused
constexpr uint16_t kMinor = 0;                // a later minor only adds sections, which are skipped

constexpr uint32_t kAlignment = 16;  // of the file's first byte and of every section
constexpr uint32_t kNameBytes = 32;  // up to 31 bytes of UTF-8 and at least one zero

// Section types. A module owns the types that share its upper digits: 0x0001.. this container,
// 0x1001.. mesh/layout.hpp, 0x2001.. curve/layout.hpp. A reader skips the types that it does not
// know.
constexpr uint32_t kBoundsSection = 0x0001;      // text: what the baker measured and proved
constexpr uint32_t kProvenanceSection = 0x0002;  // text: source, hash, options, tool version

struct Header {
  uint32_t magic;
  uint32_t byte_order;
  uint16_t major;
  uint16_t minor;
  uint32_t total_bytes;    // of the whole file, a multiple of 16
  uint32_t section_count;  // entries of the table, which begins right after the header
  uint32_t table_crc;      // of the entries
  uint32_t reserved;       // 0
  uint32_t header_crc;     // of the 28 bytes before: with the CRCs inside it, one number that tells
                           // assets apart
};
static_assert(sizeof(Header) == 32 && alignof(Header) == 4);
static_assert(offsetof(Header, total_bytes) == 12 && offsetof(Header, header_crc) == 28);

/// One section. Entries stand in strictly rising order of (name as unsigned bytes, type).
struct Entry {
  uint32_t type;
  uint32_t offset;  // from the file's first byte
  uint32_t bytes;   // at least 1, without the padding
  uint32_t crc;     // of those bytes
  char name[kNameBytes];
};
static_assert(sizeof(Entry) == 48 && offsetof(Entry, name) == 16);
static_assert(sizeof(Header) % kAlignment == 0 && sizeof(Entry) % kAlignment == 0);

}  // namespace firmtouch::asset
