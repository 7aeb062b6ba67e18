#pragma once
#include <stdint.h>

#include "firmtouch/record/ring.hpp"
#include "firmtouch/record/tick.hpp"

// Description of a record, as a table: log headers and the link carry it, so that readers of other
// versions find fields by name. A new field needs a row here.
namespace firmtouch::record {

enum class Type : uint8_t { kU32, kI32, kF32 };
constexpr uint32_t kTypeCount = 3;

/// One field of a record: `count` consecutive values of four bytes each.
struct Field {
  const char* name;  // "output.force_N"
  const char* unit;  // of value * scale + zero; "1": dimensionless; "bits": a set of flags
  float scale;
  float zero;
  Type type;
  uint8_t count;
};

/// Meaning of one bit of a field of unit "bits".
struct Bit {
  const char* field;
  const char* what;
  uint8_t bit;
};

constexpr uint32_t kFieldCount = 25;
constexpr uint32_t kBitCount = 19;

/// The fields of Numbered<TickRecord> in their order, without gaps (schema.cpp asserts it).
extern const Field kFields[kFieldCount];
/// Except those of the faults, whose names are in servo/fault.hpp.
extern const Bit kBits[kBitCount];

// The same bytes in the ring, in a log and in a frame.
static_assert(sizeof(Numbered<TickRecord>) == 156);

}  // namespace firmtouch::record
