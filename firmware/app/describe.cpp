#include "describe.hpp"

#include "firmtouch/record/schema.hpp"
#include "firmtouch/servo/fault.hpp"
#include "servo_interrupt.hpp"

namespace firmtouch::app {
namespace {

template <uint32_t N>
void put(char (&to)[N], const char* text) {
  for (uint32_t i = 0; i < N && text[i] != 0; ++i) to[i] = text[i];
}

void put_field(link::Description& row) {
  row.rows = record::kFieldCount;
  if (row.index >= row.rows) return;
  const record::Field& field = record::kFields[row.index];
  row.kind = static_cast<uint8_t>(field.type);
  row.count = field.count;
  row.number[0] = field.scale;
  row.number[1] = field.zero;
  put(row.name, field.name);
  put(row.unit, field.unit);
}

void put_bit(link::Description& row) {
  row.rows = record::kBitCount + servo::kFaultCount;
  if (row.index >= row.rows) return;
  if (row.index < record::kBitCount) {
    const record::Bit& bit = record::kBits[row.index];
    row.kind = bit.bit;
    put(row.name, bit.what);
    put(row.unit, bit.field);
  } else {
    row.kind = static_cast<uint8_t>(row.index - record::kBitCount);
    put(row.name, servo::fault_name(row.kind));
    put(row.unit, "output.faults");
    put(row.text, servo::fault_text(row.kind));
  }
}

void put_parameter(link::Description& row) {
  row.rows = static_cast<uint16_t>(controller.kTable.size());
  if (row.index >= row.rows) return;
  const params::Entry& entry = controller.kTable[row.index];
  row.kind = static_cast<uint8_t>(entry.when);
  row.number[0] = entry.low;
  row.number[1] = entry.high;
  row.number[2] = entry.initial;
  // One word: the interrupt changes it as a whole.
  row.number[3] = controller.values()[entry.number];
  put(row.name, entry.name);
  put(row.unit, entry.unit);
  put(row.text, entry.what);
}

}  // namespace

link::Description describe_row(const link::Describe& wanted) {
  link::Description row;
  row.what = wanted.what;
  row.index = wanted.index;
  if (wanted.what == link::kDescribeField) put_field(row);
  if (wanted.what == link::kDescribeBit) put_bit(row);
  if (wanted.what == link::kDescribeParameter) put_parameter(row);
  return row;
}

}  // namespace firmtouch::app
