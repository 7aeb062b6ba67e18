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

bool same(const char* a, const char* b) {
  while (*a != 0 && *a == *b) ++a, ++b;
  return *a == *b;
}

}  // namespace

void set_initial(Values& values, Table table) {
  for (float& value : values.value) value = 0;
  for (const Entry& row : table) values.value[row.number] = row.initial;
}

Values initial_values(Table table) {
  Values values;
  set_initial(values, table);
  return values;
}

bool set(Values& values, Table table, uint32_t row, float value) {
  if (row >= table.size()) return false;
  const Entry& entry = table[row];
  if (!(value >= entry.low) || !(value <= entry.high)) return false;
  values.value[entry.number] = value;
  return true;
}

uint32_t find(Table table, const char* name) {
  uint32_t i = 0;
  while (i < table.size() && !same(table[i].name, name)) ++i;
  return i;
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
