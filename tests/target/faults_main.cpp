// Starts the servo timer and ends it by the cause whose number lies in the asset's slot;
// tests/target/run_faults checks what is printed. Built for the emulator, and as for hardware.
#include <stdint.h>

#include "count.hpp"
#ifdef __arm__
#include "cortex-m/cortex_m.hpp"
#endif
#include "emulator/exit.hpp"
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/watchdog.hpp"

namespace hal = firmtouch::hal;
namespace target = firmtouch::target;
using hal::board_print;

namespace {

enum Cause : uint8_t {
  kRun,
  kExit,
  kBus,
  kUndefined,
  kOverflow,
  kWatchdog,
  kThread,
  kMaskedLoader,
  kLooseLoader
};

[[gnu::section(".noinit")]] uint32_t g_motors_off_calls;  // counted from reset; QEMU's RAM is 0
[[gnu::section(".noinit")]] bool g_is_loaded;             // by leave_boot_loader()
[[gnu::section(".noinit")]] volatile uint32_t g_strays;   // the loader's interrupts in the program
volatile uint32_t g_ticks = 0;
volatile bool g_has_power = false;
uint32_t g_ticks_at_cause = 0;

void tick() {
  volatile uint32_t on_stack = g_ticks;  // so that the handler needs one
  g_ticks = on_stack + 1;
  hal::motors_state(true);
}

[[gnu::noinline]] uint32_t fall(uint32_t depth) {
  volatile uint32_t room[64];
  room[depth % 64] = depth;
  const uint32_t below = depth == UINT32_MAX ? 0 : fall(depth + 1);
  return room[below % 64];  // used after the call, so that it cannot become a loop
}

[[noreturn, gnu::noinline]] void undefined() {
#ifdef __riscv
  asm volatile(".global undefined_here\nundefined_here: unimp");
#else
  asm volatile(".global undefined_here\nundefined_here: udf #1");
#endif
  __builtin_unreachable();
}

#ifdef __arm__
// As a thread of an operating system, on a stack of its own.
[[noreturn]] void undefined_in_thread() {
  static uint64_t stack[64];
  asm volatile(
      "msr psp, %0\n mrs r0, control\n orr r0, #2\n msr control, r0\n isb" ::"r"(stack + 64)
      : "r0", "memory");
  undefined();
}
alignas(256) void (*g_loader_vectors[16])();
extern "C" uint32_t __stack_bottom[];

void count_stray() { g_strays = g_strays + 1; }

// What a boot loader may leave: interrupts enabled and pending, all masked, on the other stack;
// both are full; or its vectors and its timer, not masked. Then it starts this program once more,
// whose first motors_off() the timer interrupts.
[[noreturn]] void leave_boot_loader(bool is_masked) {
  const uint32_t reset = hal::reg(hal::reg(hal::kVectorTable) + 4);
  if (is_masked) {
    asm volatile("cpsid i" ::: "memory");
    for (uint32_t word = 0; word < 64; word += 4) {
      hal::reg(hal::kNvicEnable + word) = UINT32_MAX;
      hal::reg(hal::kNvicPend + word) = UINT32_MAX;
    }
    hal::reg(hal::kInterruptState) = 1u << 28;  // PendSV
    hal::reg(hal::kFloatDefaultStatus) = 3u << 22;
    asm volatile("vmsr fpscr, %0" ::"r"(3u << 22));  // toward zero
    asm volatile(
        "msr basepri, %2\n msr psp, %0\n mrs r0, control\n orr r0, #2\n msr control, r0\n isb\n "
        "msr msp, %0\n bx "
        "%1" ::"r"(__stack_bottom),
        "r"(reset), "r"(hal::kServoPriority)
        : "r0", "memory");
  } else {
    for (auto& vector : g_loader_vectors) vector = count_stray;
    hal::reg(hal::kVectorTable) =
        static_cast<uint32_t>(reinterpret_cast<uintptr_t>(g_loader_vectors));
    g_strays = 0;
    asm volatile("bx %0" ::"r"(reset) : "memory");
  }
  __builtin_unreachable();
}
void pend_timer() { hal::reg(hal::kInterruptState) = 1u << 26; }
bool rounds_to_nearest() {
  uint32_t status;
  asm volatile("vmrs %0, fpscr" : "=r"(status));
  return ((status | hal::reg(hal::kFloatDefaultStatus)) >> 22 & 3u) == 0;
}
#else
[[noreturn]] void undefined_in_thread() { undefined(); }
void pend_timer() {}
bool rounds_to_nearest() { return true; }
[[noreturn]] void leave_boot_loader(bool) {
  hal::clock_start_servo(1, tick);  // soon after the start
  asm volatile("j reset_handler");
  __builtin_unreachable();
}
#endif

}  // namespace

/// The board's motors: they print when they are switched off.
namespace firmtouch::hal {

void motors_state(bool may_push) { g_has_power = may_push; }
void motors_write_N(const float (&)[3]) {}
uint32_t motors_lines() { return 0; }
void motors_off() {
  if (g_is_loaded && g_motors_off_calls == 0) pend_timer();
  g_has_power = false;
  ++g_motors_off_calls;
  if (g_ticks_at_cause != 0)
    target::print("motors off, ticks since the cause: ", g_ticks - g_ticks_at_cause);
  if (g_ticks_at_cause != 0) board_print("\n");
}

#ifdef FIRMTOUCH_AS_HARDWARE
void emulator_exit(int status) {
  const uint32_t ticks = g_ticks;
  const uint32_t from_us = clock_us();
  while (clock_us() - from_us < 20000) {
  }
  target::print("end ", static_cast<uint32_t>(status));
  target::print(", later ticks: ", g_ticks - ticks);
  target::print(", power: ", g_has_power ? 1 : 0);
  board_print("\n");
}
#endif

}  // namespace firmtouch::hal

int main() {
  const uint32_t calls_at_reset = g_motors_off_calls;
  hal::board_begin();
  target::print("running, motors off before main: ", calls_at_reset);
  board_print("\n");
  const uint8_t cause = hal::board_asset().data()[0];
  hal::clock_start_servo(1000, tick);
  if (cause == kWatchdog) hal::watchdog_begin(1000);
  while (g_ticks < 5) {
    if (cause == kWatchdog) hal::watchdog_feed();
  }
  g_ticks_at_cause = g_ticks;
  switch (cause) {
    case kExit:
      hal::board_exit(42);
    case kBus:
      return static_cast<int>(*reinterpret_cast<volatile uint32_t*>(uintptr_t{0xF0000000}));
    case kUndefined:
      undefined();
    case kOverflow:
      return static_cast<int>(fall(0));
    case kWatchdog:
      for (;;) asm volatile("nop");
    case kThread:
      undefined_in_thread();
    case kMaskedLoader:
    case kLooseLoader:
      if (!g_is_loaded) {
        g_is_loaded = true;
        g_motors_off_calls = 0;
        leave_boot_loader(cause == kMaskedLoader);
      }
      if (g_strays != 0 || !rounds_to_nearest()) return 43;
      [[fallthrough]];
    case kRun:
      while (g_ticks < 50) {
      }
      target::print("still running, power: ", g_has_power ? 1 : 0);
      board_print("\n");
      return 42;
    default:
      return 2;
  }
}
