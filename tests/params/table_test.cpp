// The table of parameters: every row sound, and no value that is not in its range ever gets in.
#include "firmtouch/params/table.hpp"

#include <float.h>
#include <stdint.h>

#include "harness/float_bits.hpp"
#include "harness/test.hpp"

namespace params = firmtouch::params;

namespace {

using firmtouch::test::bits_of;
using firmtouch::test::float_of;

// The next float away from zero, or towards +infinity from zero.
float beyond(float value, bool upwards) {
  if (!(value < 0.0f) && !(value > 0.0f)) return upwards ? FLT_TRUE_MIN : -FLT_TRUE_MIN;
  const bool away = (value > 0.0f) == upwards;
  return float_of(away ? bits_of(value) + 1 : bits_of(value) - 1);
}

bool same(const char* a, const char* b) {
  while (*a != 0 && *a == *b) ++a, ++b;
  return *a == *b;
}

}  // namespace

TEST(EveryRowHasANameAUnitAndItsInitialValueInRange) {
  for (const params::Entry& row : params::kTable) {
    CHECK(row.name != nullptr && row.name[0] != 0);
    CHECK(row.unit != nullptr && row.unit[0] != 0);
    CHECK(row.what != nullptr && row.what[0] != 0);
    CHECK_LT(row.low, row.high);
    CHECK_LE(row.low, row.initial);
    CHECK_LE(row.initial, row.high);
  }
}

TEST(NoTwoRowsHaveTheSameName) {
  for (uint32_t i = 0; i < params::kCount; ++i)
    for (uint32_t k = 0; k < i; ++k) CHECK(!same(params::kTable[i].name, params::kTable[k].name));
}

TEST(NamesSitWhereTheIndexSaysTheyDo) {
  CHECK(same(params::kTable[params::kToolRadius].name, "tool_radius_m"));
  CHECK(same(params::kTable[params::kSlewLimit].name, "slew_limit_N_per_s"));
  CHECK(same(params::kTable[params::kMaxSpeed].name, "max_speed_mps"));
  CHECK(same(params::kTable[params::kWorkspaceHalfZ].name, "workspace_half_z_m"));
  CHECK(same(params::kTable[params::kModelAge].name, "model_age"));
}

TEST(RowOf_ComposedTable_IsWhereTheNameStands) {
  constexpr params::Table kTable =
      params::Composed<params::Groups<params::SafetyRows, params::ContactRows>>::kTable;
  static_assert(params::row_of(kTable, params::kToolRadius) == 0);
  CHECK(same(kTable[params::row_of(kTable, params::kTickPeriod)].name, "tick_period_s"));
  CHECK_EQ(params::row_of(kTable, params::kGuideSnap), kTable.size());
  for (uint32_t i = 0; i < params::kCount; ++i) CHECK_EQ(params::row_of(params::kTable, i), i);
}

TEST(ValuesBeginAsTheTableSays) {
  const params::Values values = params::initial_values();
  for (uint32_t i = 0; i < params::kCount; ++i)
    CHECK_EQ(values.value[i], params::kTable[i].initial);
}

TEST(NothingOutOfRangeIsEverTaken) {
  params::Values values = params::initial_values();
  for (uint32_t i = 0; i < params::kCount; ++i) {
    const params::Entry& row = params::kTable[i];
    const float bad[] = {float_of(0x7FC00000u),
                         float_of(0xFFC00001u),
                         float_of(0x7F800000u),
                         float_of(0xFF800000u),
                         FLT_MAX,
                         -FLT_MAX,
                         beyond(row.low, false),
                         beyond(row.high, true)};
    for (const float value : bad) {
      CHECK(!params::set(values, i, value));
      CHECK_EQ(values.value[i], row.initial);
    }
    CHECK(params::set(values, i, row.low));
    CHECK_EQ(values.value[i], row.low);
    CHECK(params::set(values, i, row.high));
    CHECK_EQ(values.value[i], row.high);
    CHECK(params::set(values, i, row.initial));
  }
}

TEST(IndicesOutsideTheTableAreRefused) {
  params::Values values = params::initial_values();
  const float usual[] = {0.0f, 1.0f, -1.0f, 1e-3f, 1e3f};
  for (const float value : usual) {
    CHECK(!params::set(values, params::kCount, value));
    CHECK(!params::set(values, UINT32_MAX, value));
  }
  for (uint32_t i = 0; i < params::kCount; ++i)
    CHECK_EQ(values.value[i], params::kTable[i].initial);
}

// Logs and hosts distinguish tables by this. A row that is added changes it; so does a range.
TEST(TableHashIsTheSameEachTime) {
  CHECK(params::table_hash() == params::table_hash());
  CHECK(params::table_hash() != 0);
}
