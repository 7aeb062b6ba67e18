#pragma once
#include <stdint.h>

#include "firmtouch/record/ring.hpp"
#include "firmtouch/record/tick.hpp"

// What a record is made of, as a table: a log's header and the link tell it to readers of other
// versions. Adding a field is adding its row; a reader finds fields by name.
namespace firmtouch::record {

enum class Type : uint8_t { kU32, kI32, kF32 };
constexpr uint32_t kTypeCount = 3;

/// One field of a record: `count` values of four bytes each, one behind the other.
struct Field {
  const char* name;  // "output.force_N"
  const char* unit;  // of value * scale + zero; "1" for a plain number, "bits" for a set of them
  float scale;
  float zero;
  Type type;
  uint8_t count;
};

/// What one bit of a field of unit "bits" says.
struct Bit {
  const char* field;
  const char* what;
  uint8_t bit;
};

constexpr uint32_t kFieldCount = 22;
constexpr uint32_t kBitCount = 15;

/// The fields of Numbered<TickRecord> in their order, without gaps (schema.cpp asserts it).
extern const Field kFields[kFieldCount];
/// All but the faults', which servo names (servo/fault.hpp).
extern const Bit kBits[kBitCount];

// As it lies in the ring, on the disk and, behind a header, in a frame: two cache lines of 64 B.
static_assert(sizeof(Numbered<TickRecord>) == 128);

}  // namespace firmtouch::record
