#pragma once
#include <stddef.h>
#include <stdint.h>

// How a distance map lies in an asset, byte for byte (tools/FORMAT.md says it in words). The baker
// writes these structs, the firmware reads them in place: 6 bytes a cell.

namespace firmtouch::field {

// Section types of one map; it shares the name of its mesh.
constexpr uint32_t kHeadSection = 0x3001;
constexpr uint32_t kDistancesSection = 0x3002;  // int16_t[cells], x fastest
constexpr uint32_t kSeedsSection = 0x3003;      // uint32_t[cells]: query::Hint::place of the mesh

constexpr uint32_t kMaxCellsAnAxis = 1024;
constexpr uint32_t kMaxCells = 1u << 24;

struct Head {
  uint32_t count[3];     // cells on x, y, z
  uint32_t is_signed;    // as the mesh's
  float low_m[3];        // corner of cell 0
  float cell_m;          // side of a cell
  float quantum_m;       // a power of two
  uint32_t reserved[3];  // 0
};
static_assert(sizeof(Head) == 48 && alignof(Head) == 4);
static_assert(offsetof(Head, low_m) == 16 && offsetof(Head, quantum_m) == 32);

// A cell's word says of the distance d at its centre, with m = word where it is not negative, else
// -1 - word: m quanta <= d <= m + kWide quanta; and where m > 0 the side, inside where the word is
// negative. kUnknown says nothing.
constexpr int16_t kUnknown = -32768;
constexpr uint32_t kMaxQuanta = 32766;
constexpr uint32_t kWide = 2;
constexpr uint32_t quanta_of(int16_t word) {
  return static_cast<uint32_t>(word >= 0 ? word : -1 - word);
}

}  // namespace firmtouch::field
