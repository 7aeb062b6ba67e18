#include <string>

#include "crash_record/kept.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/watchdog.hpp"
#include "harness/test.hpp"
#include "registers.hpp"

// The crash record, with the reset causes of an STM32 (NUCLEO-G474RE) in memory. The kept entries
// are those that a reset leaves; tests/target/run_crash resets an emulated chip.

using namespace firmtouch;
using namespace firmtouch::hal;

namespace {

std::string printed;
constexpr uint32_t kCauses = 0x40021094, kWatchdogBit = 1u << 29, kPinBit = 1u << 26,
                   kForget = 1u << 23;

CrashRecord after_reset(uint32_t causes) {
  registers.clear();
  registers[kCauses] = causes;
  for (uint32_t tick = 100; tick < 120; ++tick) crash_keep_tick({tick, 0, 0, 0});
  CrashRecord record;
  CHECK(crash_take(record));
  CHECK_EQ(record.ticks, 8u);
  CHECK_EQ(registers[kCauses] & kForget, kForget);
  return record;
}

}  // namespace

void firmtouch::hal::board_print(const char* text) { printed += text; }

TEST(CrashRecord_ResetByAWatchdogThatDoesNotWarn_IsTheWatchdogs) {
  CrashRecord record = after_reset(kWatchdogBit | kPinBit);
  CHECK(record.cause == CrashCause::kWatchdog);
  printed.clear();
  crash_print(record);
  CHECK(printed.find("ended by the watchdog") != std::string::npos);
  record = after_reset(kPinBit);
  CHECK(record.cause == CrashCause::kReset);
}

TEST(CrashRecord_WatchdogBehindAFault_IsNotTheCause) {
  crash_keep_cause(CrashCause::kFault, 0x1234, 0x5678, 1);
  const CrashRecord record = after_reset(kWatchdogBit);
  CHECK(record.cause == CrashCause::kFault);
  CHECK_EQ(record.pc, 0x1234u);
}

TEST(CrashRecord_OfPowerUp_IsEmptyWhateverTheChipSays) {
  registers.clear();
  registers[kCauses] = kWatchdogBit;
  g_crash_cause = {};
  for (Kept& kept : g_crash_ticks) kept = {};
  CrashRecord record;
  CHECK(!crash_take(record));
}
