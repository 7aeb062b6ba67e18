// Parameters in two flash sectors, with the power cut in every operation of every update: the old
// ones or the new ones are there, whole.
#include "firmtouch/params/saved.hpp"

#include <cstdint>
#include <cstdlib>
#include <cstring>

#include "firmtouch/params/table.hpp"
#include "harness/random.hpp"
#include "harness/test.hpp"
#include "harness/torn_flash.hpp"

namespace firmtouch::params {
namespace {

using test::Cut;
using test::PowerCut;
using Flash = test::TornFlash;

core::Bytes bytes_of(const Saved& saved) {
  return {reinterpret_cast<const uint8_t*>(&saved), sizeof saved};
}

Values values_of(uint32_t update) {
  Values values = initial_values();
  CHECK(set(values, kForceLimit, 1.0f + static_cast<float>(update % 64)));
  CHECK(set(values, kOriginZ, static_cast<float>(update) * 0.001f));
  CHECK(set(values, kMaxSpeed, 1.0f + static_cast<float>(update % 9)));
  return values;
}

// One start of the device and one save, as firmware/app/saved_parameters.cpp does them.
void start_and_save(Flash& flash, uint32_t update) {
  for (uint32_t s; (s = sector_to_erase(flash.view().area)) < 2;) flash.erase(s);
  SavedSlot slot;
  CHECK(next_slot(flash.view().area, slot));
  Saved saved;
  save_into(saved, newest_saved(flash.view().area), kTable, values_of(update));
  flash.program(slot.sector, slot.offset, bytes_of(saved));
}

// Which update is in flash; UINT32_MAX: none.
uint32_t found(const Flash& flash, uint32_t old_update, uint32_t new_update) {
  const Saved* const saved = newest_saved(flash.view().area);
  if (saved == nullptr) return UINT32_MAX;
  for (const uint32_t update : {old_update, new_update}) {
    Values values = initial_values();
    float value = 0;
    for (uint32_t row = 0; (row = next_saved(*saved, kTable, true, row, value)) < kTable.size();
         ++row)
      CHECK(set(values, row, value));
    const Values wanted = values_of(update);
    if (std::memcmp(&values, &wanted, sizeof values) == 0) return update;
  }
  CHECK(false);  // mixed
  return UINT32_MAX;
}

uint32_t attack(uint32_t sector_bytes, uint32_t unit_bytes, uint32_t updates) {
  Flash flash(sector_bytes, sector_bytes, unit_bytes);
  test::Xorshift random(sector_bytes + unit_bytes);
  flash.fill(random);
  start_and_save(flash, 0);
  uint32_t cuts = 0;
  for (uint32_t update = 1; update <= updates; ++update) {
    Flash whole = flash;
    start_and_save(whole, update);
    const uint32_t operations = whole.operations() - flash.operations();
    for (uint32_t operation = 0; operation < operations; ++operation) {
      for (const Cut cut : {Cut::kBefore, Cut::kTorn, Cut::kBehind}) {
        Flash hurt = flash;
        hurt.cut_at(operation, cut);
        bool was_cut = false;
        try {
          start_and_save(hurt, update);
        } catch (const PowerCut&) {
          was_cut = true;
        }
        CHECK(was_cut);
        const uint32_t now = found(hurt, update - 1, update);
        CHECK(now == update - 1 || (now == update && operation + 1 == operations));
        hurt.cut_at(random() % operations, Cut::kTorn);  // the next start is cut as well
        try {
          start_and_save(hurt, update + 1);
        } catch (const PowerCut&) {
        }
        hurt.cut_at(0, Cut::kNone);
        const uint32_t then = found(hurt, now, update + 1);
        CHECK(then == now || then == update + 1);
        start_and_save(hurt, update + 1);  // the next update is still possible
        CHECK_EQ(found(hurt, now, update + 1), update + 1);
        ++cuts;
      }
    }
    flash = whole;
    CHECK_EQ(found(flash, update - 1, update), update);
  }
  return cuts;
}

TEST(SavedParameters_PowerCutInEveryFlashOperation_OldOrNewWhole) {
  const uint32_t updates = std::getenv("FIRMTOUCH_LONG") != nullptr ? 1000 : 40;
  CHECK_GE(attack(2048, 8, updates), updates * 100);   // STM32G4
  CHECK_GE(attack(4096, 4, updates), updates * 200);   // STM32F4's word, a small sector
  CHECK_GE(attack(16384, 32, updates), updates * 27);  // STM32H7's word
}

TEST(SavedParameters_EveryFlippedBit_IsNoticed) {
  Flash flash(2048, 2048, 8);
  start_and_save(flash, 1);
  start_and_save(flash, 2);
  for (uint32_t bit = 0; bit < sizeof(Saved) * 8; ++bit) {
    Flash hurt = flash;
    hurt.bytes(0)[sizeof(Saved) + bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
    CHECK_EQ(found(hurt, 1, 2), 1u);
  }
}

TEST(SavedParameters_SequenceWraps_NewestStillCounts) {
  Flash flash(2048, 2048, 8);
  flash.erase(0);
  flash.erase(1);
  Saved last, saved;
  last.sequence = UINT32_MAX - 1;
  save_into(last, &last, kTable, values_of(1));
  CHECK_EQ(last.sequence, UINT32_MAX);
  save_into(saved, &last, kTable, values_of(2));
  CHECK_EQ(saved.sequence, 0u);
  flash.program(1, 0, bytes_of(saved));
  flash.program(0, 0, bytes_of(last));
  CHECK_EQ(found(flash, 1, 2), 2u);
}

TEST(SavedParameters_OwnRowsOfAnotherTable_AreLeftOut) {
  static constexpr Entry kOwn[] = {
      {kForceLimit, "force_limit_N", "N", 0.0f, 100.0f, 8.0f, When::kMayFall, "force"},
      {kFirstOwn, "own", "1", 0.0f, 9.0f, 1.0f, When::kAnytime, "own"}};
  const Table table{kOwn, 2};
  Values values;
  set_initial(values, table);
  CHECK(set(values, table, 0, 5.0f));
  CHECK(set(values, table, 1, 6.0f));
  Saved saved;
  save_into(saved, nullptr, table, values);
  float value = 0;
  CHECK_EQ(next_saved(saved, table, false, 0, value), 0u);
  CHECK_EQ(value, 5.0f);
  CHECK_EQ(next_saved(saved, table, false, 1, value), 2u);
  CHECK_EQ(next_saved(saved, table, true, 1, value), 1u);
  CHECK_EQ(value, 6.0f);
}

}  // namespace
}  // namespace firmtouch::params
