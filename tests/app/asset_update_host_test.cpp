// Assets that a host loads into two slots of flash, with the power cut in every operation of every
// update: the old one or the new one is there, whole. And what the motors do meanwhile.
#include "asset_update.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cstring>

#include "app/moved_joints.hpp"
#include "app/tick_source.hpp"
#include "firmtouch/asset/slots.hpp"
#include "firmtouch/core/crc32.hpp"
#include "firmtouch/hal/asset_slots.hpp"
#include "harness/long.hpp"
#include "harness/test.hpp"
#include "harness/torn_flash.hpp"
#include "servo.hpp"
#include "servo_interrupt.hpp"

namespace firmtouch {
namespace {

// The program's state is static, and so is its flash.
test::TornFlash flash{4096, 4096, 256};
uint32_t sector_bytes = 4096;

}  // namespace

namespace hal {

AssetSlots board_asset_slots() {
  const test::TornFlash::View view = flash.view();
  return {{view.area[0], view.area[1]}, sector_bytes};
}
bool board_erase_asset(uint32_t slot, uint32_t offset) {
  flash.erase(slot, offset);
  return true;
}
bool board_program_asset(uint32_t slot, uint32_t offset, core::Bytes bytes) {
  flash.program(slot, offset, bytes);
  return true;
}

}  // namespace hal

namespace app_test {
namespace {

using app::asset_update;
using test::Cut;
using test::PowerCut;

AssetFile& file(uint32_t update) {
  static AssetFile files[] = {AssetFile(FIRMTOUCH_TEST_ASSET), AssetFile(FIRMTOUCH_TEST_OTHER)};
  return files[update % 2];
}

// Start-up, as firmware/app/main.cpp does it. Result: whether an asset of a slot was opened.
bool start() {
  asset_update = {};
  for (uint32_t i = 0; i < 2; ++i) {
    const core::Bytes loaded = app::loaded_asset(i);
    if (!loaded.empty() && app::controller.open(loaded).ok()) return true;
  }
  static const uint8_t none[16] = {};
  CHECK(!app::controller.open({none, 0}).ok());
  return false;
}

uint32_t begin(core::Bytes asset) {
  return asset_update.begin({link::kProtocolVersion, asset.size(), core::crc32(asset)}).result;
}

link::AssetAck put(core::Bytes asset, uint32_t offset) {
  link::AssetBlock block;
  block.offset = offset;
  const uint32_t left = asset.size() - offset;
  std::memcpy(block.data, asset.data() + offset,
              left < link::kAssetBlockBytes ? left : link::kAssetBlockBytes);
  return asset_update.put(block);
}

link::AssetAck commit() {
  link::AssetAck ack;
  while ((ack = asset_update.commit()).result == link::kAckBusy) asset_update.work();
  return ack;
}

link::AssetAck load(core::Bytes asset) {
  CHECK_EQ(begin(asset), link::kAckTaken);
  for (uint32_t next = 0; next < asset.size();) {
    const link::AssetAck ack = put(asset, next);
    CHECK_EQ(ack.result, link::kAckTaken);
    if (ack.result != link::kAckTaken) return ack;
    next = ack.next;
  }
  return commit();
}

bool is_in_slots(core::Bytes asset) {
  const core::Bytes found = app::loaded_asset(0);
  return found.size() == asset.size() && std::memcmp(found.data(), asset.data(), asset.size()) == 0;
}

// Cuts the power in one operation of an update; then the old asset or the new one must be opened.
// Result: whether there was such an operation.
bool is_whole_after(uint32_t update, uint32_t operation, Cut cut) {
  flash.cut_at(operation, cut);
  bool was_cut = false;
  try {
    load(file(update).bytes());
  } catch (const PowerCut&) {
    was_cut = true;
  }
  flash.cut_at(0, Cut::kNone);
  if (!was_cut) return false;
  CHECK(start());
  CHECK(is_in_slots(file(update).bytes()) || is_in_slots(file(update - 1).bytes()));
  CHECK(app::controller.asset().data() == app::loaded_asset(0).data());
  return true;
}

// And the next update must be possible, also if it is cut as well at first.
bool survives(uint32_t update, uint32_t operation, Cut cut) {
  if (!is_whole_after(update, operation, cut)) return false;
  if (operation % 16 == 0) {
    static test::Xorshift random(26);
    is_whole_after(update, random() % (operation + 1), Cut::kTorn);
    CHECK_EQ(load(file(update).bytes()).result, link::kAckTaken);
    CHECK(is_in_slots(file(update).bytes()));
  }
  return true;
}

// Result: number of power cuts.
uint32_t attack(uint32_t slot_bytes, uint32_t sector, uint32_t unit, uint32_t updates) {
  flash = test::TornFlash(slot_bytes, sector, unit);
  sector_bytes = sector;
  test::Xorshift random(slot_bytes + unit);
  flash.fill(random);
  CHECK(!start());
  CHECK_EQ(load(file(0).bytes()).result, link::kAckTaken);
  uint32_t cuts = 0;
  for (uint32_t update = 1; update <= updates; ++update) {
    CHECK(start());
    const test::TornFlash before = flash;
    for (const Cut cut : {Cut::kBefore, Cut::kTorn, Cut::kBehind}) {
      for (uint32_t operation = 0;; ++operation) {
        flash = before;
        CHECK(start());
        if (!survives(update, operation, cut)) break;
        ++cuts;
      }
    }
    CHECK(is_in_slots(file(update).bytes()));  // the last one was not cut
  }
  return cuts;
}

// Operations of an update: the larger asset of 4,192 bytes and the smaller of 2,208 in turn.
TEST(AssetUpdate_PowerCutInEveryFlashOperation_OldOrNewWhole) {
  const uint32_t updates = test::is_long() ? 1000 : 20;
  CHECK_GE(attack(16384, 2048, 8, updates), updates * 3 * 400);      // STM32G4
  CHECK_GE(attack(131072, 131072, 32, updates), updates * 3 * 100);  // STM32H7
  CHECK_GE(attack(16384, 4096, 256, updates), updates * 3 * 14);     // external flash
}

void begin_with_first() {
  flash = test::TornFlash(16384, 4096, 256);
  sector_bytes = 4096;
  start();
  CHECK_EQ(load(file(0).bytes()).result, link::kAckTaken);
}

bool in_use_is(core::Bytes asset) {
  const core::Bytes used = app::controller.asset();
  return used.size() == asset.size() && std::memcmp(used.data(), asset.data(), used.size()) == 0;
}

TEST(AssetUpdate_Taken_IsInUseAtOnceAndAfterARestart) {
  begin_with_first();
  for (uint32_t update = 1; update < 6; ++update) {
    CHECK_EQ(load(file(update).bytes()).result, link::kAckTaken);
    CHECK(in_use_is(file(update).bytes()));
    CHECK_EQ(commit().result, link::kAckTaken);  // its answer was lost
    if (update % 2 == 0) CHECK(start());
    CHECK(in_use_is(file(update).bytes()));
  }
}

// The scene of the asset before refers to the slot that is about to be erased. An update that stops
// there, and a lock-step whose ticks swap, touched flash that nobody had proven.
TEST(AssetUpdate_ThatHasBegun_LeavesNothingToSwapTo) {
  begin_with_first();
  CHECK_EQ(load(file(1).bytes()).result, link::kAckTaken);
  CHECK(app::controller.can_swap());  // back
  CHECK_EQ(begin(file(0).bytes()), link::kAckTaken);
  CHECK(!app::controller.can_swap());
  asset_update.abort();
  CHECK(!app::controller.swap());
  CHECK(in_use_is(file(1).bytes()));
}

// Each flipped bit of an asset whose blocks and CRC arrive as sent.
TEST(AssetUpdate_DamagedAsset_IsRejectedAndTheOldOneStays) {
  begin_with_first();
  AssetFile damaged(FIRMTOUCH_TEST_OTHER);
  for (uint32_t bit = 0; bit < damaged.bytes().size() * 8; bit += 37) {
    damaged.data()[bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
    const link::AssetAck ack = load(damaged.bytes());
    CHECK_EQ(ack.result, link::kAckAssetRejected);
    CHECK(ack.rule != 0);
    CHECK(in_use_is(file(0).bytes()) && is_in_slots(file(0).bytes()));
    damaged.data()[bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
  }
  CHECK_EQ(load(damaged.bytes()).result, link::kAckTaken);
}

TEST(AssetUpdate_EveryFlippedBitOfAMark_IsNoticed) {
  begin_with_first();
  CHECK_EQ(load(file(1).bytes()).result, link::kAckTaken);
  const hal::AssetSlots slots = hal::board_asset_slots();
  const uint32_t newest = asset::newest_slot(slots.slot);
  uint8_t* const mark = flash.bytes(newest) + slots.slot[newest].size() - sizeof(asset::SlotMark);
  for (uint32_t bit = 0; bit < sizeof(asset::SlotMark) * 8; ++bit) {
    mark[bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
    CHECK(is_in_slots(file(0).bytes()));
    mark[bit / 8] ^= static_cast<uint8_t>(1u << bit % 8);
  }
  CHECK(is_in_slots(file(1).bytes()));
}

TEST(AssetUpdate_FlippedBitInFlashBehindTheMark_TheOtherAssetIsOpened) {
  begin_with_first();
  CHECK_EQ(load(file(1).bytes()).result, link::kAckTaken);
  uint8_t* const newest = flash.bytes(0) + (app::loaded_asset(0).data() - flash.bytes(0));
  newest[1000] ^= 4;
  CHECK(start());
  CHECK(in_use_is(file(0).bytes()));
  CHECK_EQ(load(file(1).bytes()).result, link::kAckTaken);  // over the damaged one
  CHECK(start());
  CHECK(in_use_is(file(1).bytes()));
}

TEST(AssetUpdate_RequestsOutOfTurn_AreAnsweredByName) {
  begin_with_first();
  const core::Bytes asset = file(1).bytes();
  asset_update.abort();
  CHECK_EQ(put(asset, 0).result, link::kAckNoUpdate);
  CHECK_EQ(commit().result, link::kAckNoUpdate);
  CHECK_EQ(asset_update.begin({link::kProtocolVersion + 1, 2208, 0}).result,
           link::kAckOtherProtocol);
  for (const uint32_t bytes : {0u, 16u, 2209u, 16384u, 0xFFFFFFF0u})
    CHECK_EQ(asset_update.begin({link::kProtocolVersion, bytes, 0}).result, link::kAckOutOfRange);
  CHECK_EQ(begin(asset), link::kAckTaken);
  CHECK_EQ(put(asset, 448).next, 0u);  // a gap
  CHECK_EQ(put(asset, 0).next, 224u);
  CHECK_EQ(put(asset, 0).next, 224u);  // again: its answer was lost
  CHECK_EQ(commit().result, link::kAckOutOfRange);
  CHECK_EQ(put(asset, 224).next, 448u);
  CHECK_EQ(asset_update.begin({link::kProtocolVersion, asset.size(), 1}).result, link::kAckTaken);
  for (uint32_t next = 0; next < asset.size();) next = put(asset, next).next;
  CHECK_EQ(commit().result, link::kAckWrongCrc);
  CHECK(in_use_is(file(0).bytes()));
}

// One that was flashed without a mark, and is longer than a slot.
TEST(AssetUpdate_AssetInUseReachesIntoBothSlots_IsRefused) {
  flash = test::TornFlash(4096, 4096, 256);
  sector_bytes = 4096;
  start();
  const core::Bytes whole = file(0).bytes();
  CHECK_EQ(begin(whole), link::kAckOutOfRange);
  std::memcpy(flash.bytes(0), whole.data(), whole.size());
  CHECK(app::controller.open({flash.bytes(0), whole.size()}).ok());
  CHECK_EQ(begin(file(1).bytes()), link::kAckAssetInTheWay);
  CHECK(in_use_is(whole));
}

// What follows needs the program's own servo, whose state is static: a process for each.
bool in_child(bool (*passes)()) {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(passes() ? 0 : 1);
  int status = 0;
  ::waitpid(child, &status, 0);
  return WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

void tick() {
  app::servo_interrupt();
  ++joints.tick;
}
bool ticks_that_push(uint32_t count) {
  bool any = false;
  for (; count > 0; --count) {
    tick();
    any |= app::motors_may_push();
  }
  return any;
}

// input_of() closes the enable switch in tick 10 and never opens it.
bool motors_stay_off() {
  begin_with_first();
  app::start_servo();
  if (!ticks_that_push(100)) return false;
  if (begin(file(1).bytes()) != link::kAckMotorsOn) return false;
  if (!ticks_that_push(1)) return false;  // a refused request takes nothing
  joints.lines = ~record::kFlagEnable;
  ticks_that_push(50);
  if (app::motors_may_push() || begin(file(1).bytes()) != link::kAckTaken) return false;
  joints.lines = UINT32_MAX;
  if (ticks_that_push(100)) return false;  // held off while it is written
  asset_update.abort();
  if (ticks_that_push(100)) return false;  // and until the switch was seen open
  joints.lines = ~record::kFlagEnable;
  tick();
  joints.lines = UINT32_MAX;
  return ticks_that_push(100);
}

TEST(AssetUpdate_MotorsOn_IsRefused_AndHeldOffUntilTheSwitchWasOpened) {
  CHECK(in_child(motors_stay_off));
}

// The swap is a tick's command: its record says so, and the tick after it touches the other asset.
bool swap_is_recorded() {
  begin_with_first();
  app::start_servo();
  for (uint32_t i = 0; i < 5; ++i) tick();
  uint32_t swaps = 0;
  const auto next_tick = [&swaps] {
    tick();
    record::Numbered<record::TickRecord> last[1];
    if (app::records.pop(last) == 1 && last[0].value.input.command == record::kCommandSwapAsset)
      swaps += (last[0].value.output.state & record::kStateCommandTaken) != 0;
  };
  const core::Bytes asset = file(1).bytes();
  if (begin(asset) != link::kAckTaken) return false;
  for (uint32_t next = 0; next < asset.size(); next_tick()) next = put(asset, next).next;
  link::AssetAck ack;
  while ((ack = asset_update.commit()).result == link::kAckBusy) {
    asset_update.work();
    if (!in_use_is(asset)) next_tick();
  }
  for (uint32_t i = 0; i < 64; ++i) next_tick();  // the first ticks' records are read, too
  return ack.result == link::kAckTaken && in_use_is(asset) && swaps == 1;
}

TEST(AssetUpdate_WhileTheServoRuns_TheSwapIsInTheRecord) { CHECK(in_child(swap_is_recorded)); }

}  // namespace
}  // namespace app_test
}  // namespace firmtouch
