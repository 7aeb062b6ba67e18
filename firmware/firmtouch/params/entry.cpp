#include "firmtouch/params/entry.hpp"

#include "firmtouch/core/hash.hpp"

namespace firmtouch::params {
namespace {

void add_text(core::Hash& hash, const char* text) {
  for (; *text != 0; ++text) hash.add(static_cast<unsigned char>(*text));
  hash.add(0);
}

void add_float(core::Hash& hash, float value) {
  uint32_t bits;
  __builtin_memcpy(&bits, &value, sizeof bits);
  hash.add(bits);
}

}  // namespace

void set_initial(Values& values, Table table) {
  for (float& value : values.value) value = 0;
  for (const Entry& row : table) values.value[row.number] = row.initial;
}

bool set(Values& values, Table table, uint32_t row, float value) {
  if (row >= table.size()) return false;
  const Entry& entry = table[row];
  if (!(value >= entry.low) || !(value <= entry.high)) return false;
  values.value[entry.number] = value;
  return true;
}

uint64_t table_hash(Table table) {
  core::Hash hash;
  for (const Entry& row : table) {
    add_text(hash, row.name);
    add_text(hash, row.unit);
    add_float(hash, row.low);
    add_float(hash, row.high);
    add_float(hash, row.initial);
    hash.add(static_cast<uint32_t>(row.when));
  }
  return hash.value();
}

}  // namespace firmtouch::params
