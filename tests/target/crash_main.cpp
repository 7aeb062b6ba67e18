// Ends by the cause whose number lies in the asset's slot, is reset, and prints what was left;
// tests/target/run_crash checks it. Built as for hardware: the reset stands for the watchdog's.
#include <stdint.h>

#include "cortex-m/cortex_m.hpp"
#include "crash_record/kept.hpp"
#include "emulator/exit.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hal/watchdog.hpp"
#include "target/text.hpp"

namespace hal = firmtouch::hal;

namespace {

enum Cause : uint8_t { kReset, kBus, kUndefined, kOverflow, kWatchdog, kTorn, kPower };
constexpr uint32_t kFirstTick = 0xFFFFFFF0u;  // the number runs over within a run

volatile uint32_t g_ticks = 0;

void tick() {
  const uint32_t number = kFirstTick + g_ticks;
  hal::crash_keep_tick({number, hal::clock_us(), 0x100u + g_ticks, 0x8u});
  g_ticks = g_ticks + 1;
}

// A tick's own share, before the first one takes the entry's place.
void print_work() {
  const hal::CrashTick first{kFirstTick, 0, 0, 0};
  const uint32_t before = hal::clock_work();
  hal::crash_keep_tick(first);
  const uint64_t work = hal::clock_work() - before;
  hal::board_print("a tick is kept in instructions: ");
  hal::board_print(firmtouch::target::decimal(work * 1000 / hal::clock_work_per_1000()).text);
  hal::board_print("\n");
}

[[noreturn]] void reset() {
  constexpr uint32_t kApplicationInterruptControl = 0xE000ED0C;
  hal::reg(kApplicationInterruptControl) = 0x05FA0004;  // SYSRESETREQ
  for (;;) asm volatile("dsb");
}

[[gnu::noinline]] uint32_t fall(uint32_t depth) {
  volatile uint32_t room[64];
  room[depth % 64] = depth;
  const uint32_t below = depth == UINT32_MAX ? 0 : fall(depth + 1);
  return room[below % 64];
}

void end_by(uint8_t cause) {
  switch (cause) {
    case kBus:
      (void)*reinterpret_cast<volatile uint32_t*>(uintptr_t{0xF0000000});
      return;
    case kUndefined:
      asm volatile(".global undefined_here\nundefined_here: udf #1");
      return;
    case kOverflow:
      (void)fall(0);
      return;
    case kWatchdog:
      for (;;) asm volatile("nop");
    case kTorn:  // in the middle of the third tick before the last
      hal::g_crash_ticks[(kFirstTick + g_ticks - 3) % hal::kCrashTicks].words[2] ^= 0x40u;
      return;
    case kPower:  // RAM lost its contents
      hal::g_crash_cause = {};
      for (hal::Kept& kept : hal::g_crash_ticks) kept = {};
      return;
    default:
      return;
  }
}

}  // namespace

/// What board_exit() ends with behind a fault.
void firmtouch::hal::emulator_exit(int) { reset(); }

int main() {
  static bool again [[gnu::section(".noinit")]];  // QEMU's RAM is 0 at power-up
  hal::board_begin();
  hal::CrashRecord record;
  if (hal::crash_take(record)) hal::crash_print(record);
  if (again) {
    hal::board_print(hal::crash_take(record) ? "end, still there\n" : "end, taken\n");
    for (;;) asm volatile("nop");
  }
  again = true;
  print_work();
  const uint8_t cause = hal::board_asset().data()[0];
  hal::clock_start_servo(1000, tick);
  if (cause == kWatchdog) hal::watchdog_begin(1000);
  while (g_ticks < 20) {
    if (cause == kWatchdog) hal::watchdog_feed();
  }
  asm volatile("cpsid i" ::: "memory");
  end_by(cause);
  reset();
}
