#pragma once
#include "firmtouch/params/compose.hpp"
#include "firmtouch/params/entry.hpp"
#include "firmtouch/params/rows.hpp"

// The table of the full controller (controller/full_controller.hpp): all rows, where a number is
// the row. Hosts name parameters by it.
namespace firmtouch::params {

constexpr Table kTable = Composed<Groups<SafetyRows, DeviceRows, SceneRows, ContactRows,
                                         FrictionRows, ShadingRows, SheetRows, GuideRows>>::kTable;
static_assert(kTable.size() == kCount, "a number has no row");

inline Values initial_values() {
  Values values;
  set_initial(values, kTable);
  return values;
}
inline bool set(Values& values, uint32_t row, float value) {
  return set(values, kTable, row, value);
}
inline uint64_t table_hash() { return table_hash(kTable); }

}  // namespace firmtouch::params
