#pragma once
#include <stddef.h>
#include <stdint.h>

// How a distance field lies in an asset, byte for byte (tools/FORMAT.md says it in words). The
// baker writes these structs, the firmware reads them in place: 6 bytes a cell.

namespace firmtouch::field {

// Section types of one field; it shares the name of its mesh.
constexpr uint32_t kHeadSection = 0x3001;
constexpr uint32_t kDistancesSection = 0x3002;  // int16_t[cells], x fastest
constexpr uint32_t kSeedsSection = 0x3003;      // uint32_t[cells]: mesh::Hint::leaf_slot

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
// negative. kUnknown states nothing.
constexpr int16_t kUnknown = -32768;
constexpr uint32_t kMaxQuanta = 32766;
constexpr uint32_t kWide = 2;
constexpr uint32_t quanta_of(int16_t word) {
  return static_cast<uint32_t>(word >= 0 ? word : -1 - word);
}

/// Why opening rejects; the numbers never change. tools/FORMAT.md prints the same text.
enum Rule : uint16_t {
  // The head is absent or not 48 bytes long.
  kRuleHeadSize = 301,
  // An axis has no cells or more than 1024 (0 to 2), or there are more than 2^24 cells (3).
  kRuleCellCount = 302,
  // The bounds section does not hold one word a cell.
  kRuleDistancesSize = 303,
  // The seed section does not hold one word a cell.
  kRuleSeedsSize = 304,
  // No mesh has this name, or is_signed differs from the mesh's.
  kRuleMesh = 305,
  // A reserved word is not 0.
  kRuleReserved = 306,
  // The grid begins beyond 1e8 m or does not contain the mesh's box.
  kRuleGrid = 307,
  // The cell is smaller than 1e-12 m or larger than 1e8 m.
  kRuleCell = 308,
  // The quantum is no power of two from 2^-95 to 2^65.
  kRuleQuantum = 309,
  // A query of the mesh at the cell's centre contradicts the cell's bounds or sign.
  kRuleDistance = 310,
};

}  // namespace firmtouch::field
