#include <stdint.h>

#ifdef __arm__
#include "cortex-m/floating_point.hpp"
#endif
#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hal/encoders.hpp"
#include "firmtouch/hal/motors.hpp"
#include "firmtouch/hal/parameters.hpp"
#include "harness/test.hpp"
#include "parts/loop.hpp"

// The contracts of firmtouch/hal, on the board itself. The virtual clock advances by a fixed time
// an instruction, so that counts are exact.

using namespace firmtouch;

namespace {

volatile uint32_t ticks_seen = 0;

void count_tick() { ticks_seen = ticks_seen + 1; }

[[gnu::noinline]] uint32_t instructions_of_loop(uint32_t turns) {
  const uint32_t before = hal::clock_work();
  hal::turn(turns);
  const uint64_t work = hal::clock_work() - before;
  const uint32_t per_1000 = hal::clock_work_per_1000();
  return static_cast<uint32_t>((work * 1000 + per_1000 / 2) / per_1000);
}

[[gnu::noinline]] uint32_t deep(uint32_t bytes) {
  volatile uint8_t room[2048];
  for (uint32_t i = 0; i < bytes; ++i) room[i] = static_cast<uint8_t>(i);
  return room[bytes / 2];
}

void check_servo_period(uint32_t period_us, uint32_t periods) {
  hal::clock_start_servo(period_us, count_tick);
  const uint32_t start_us = hal::clock_us();
  const uint32_t start_ticks = ticks_seen;
  while (ticks_seen - start_ticks < periods) {
  }
  const uint32_t took_us = hal::clock_us() - start_us;
  CHECK_GE(took_us, (periods - 1) * period_us);
  CHECK_LE(took_us, (periods + 1) * period_us);
}

}  // namespace

TEST(Work_CountsInstructionsExactly) {
  uint32_t few = 1000, many = 51000;
  asm volatile("" : "+r"(few), "+r"(many));  // with -flto else a copy of the function for each
  const uint32_t short_one = instructions_of_loop(few);
  const uint32_t long_one = instructions_of_loop(many);
  CHECK_GE(short_one, 2000u);
  CHECK_LE(short_one, 2012u);              // the two reads of the clock and what surrounds them
  CHECK_GE(long_one - short_one, 99999u);  // one instruction of rounding
  CHECK_LE(long_one - short_one, 100001u);
}

TEST(ServoInterrupt_OncePerPeriod_MicrosecondsContinue) { check_servo_period(100, 50); }

TEST(ServoInterrupt_SecondStart_ChangesThePeriod) {
  constexpr uint32_t kPeriods_us[] = {100, 250, 80};
  for (const uint32_t period_us : kPeriods_us) check_servo_period(period_us, 20);
}

#ifdef __arm__
TEST(FloatingPoint_ModesOfABootLoader_AreClearedHereAndForInterrupts) {
  constexpr uint32_t kModes = 0x07C00000;
  auto& at_interrupt = *reinterpret_cast<volatile uint32_t*>(uintptr_t{0xE000EF3C});
  uint32_t status;
  asm volatile("vmrs %0, fpscr" : "=r"(status));
  at_interrupt = at_interrupt | 0x01C00000;  // toward zero, flush to zero
  asm volatile("vmsr fpscr, %0" ::"r"(status | 0x01C00000));
  hal::floating_point_begin();
  asm volatile("vmrs %0, fpscr" : "=r"(status));
  CHECK_EQ(status & kModes, 0u);
  CHECK_EQ(at_interrupt & kModes, 0u);
}
#endif

TEST(ParameterFlash_ErasedThenProgrammed_OnlyClearsBits) {
  const hal::ParameterFlash flash = hal::board_parameters();
  CHECK(flash.sector[0].empty() == flash.sector[1].empty());
  CHECK_EQ(flash.sector[0].size(), flash.sector[1].size());
  CHECK_EQ(reinterpret_cast<uintptr_t>(flash.sector[0].data()) % 32, 0u);
  // QEMU has no flash controller of the STM32.
  if (!hal::board_erase_parameters(0) || flash.sector[0].data()[0] != 0xFF) return;
  alignas(32) uint8_t bytes[32] = {1, 2, 3};
  CHECK(hal::board_program_parameters(0, 64, {bytes, 32}));
  CHECK_EQ(flash.sector[0].data()[63], 0xFF);
  CHECK_EQ(flash.sector[0].data()[65], 2);
  CHECK_EQ(flash.sector[0].data()[96], 0xFF);
}

TEST(StackHighWater_IncludesDeepCall) {
  const uint32_t before_bytes = hal::board_stack_high_bytes();
  CHECK_GT(before_bytes, 0u);
  deep(2048);
  CHECK_GE(hal::board_stack_high_bytes(), 2048u);
}

TEST(BoardAsset_IsAligned) {
  CHECK_EQ(reinterpret_cast<uintptr_t>(hal::board_asset().data()) % 16, 0u);
}

TEST(NoJoints_NeverEnablesMotors) {
  int32_t counts[3] = {1, 2, 3};
  CHECK(!hal::encoders_read(counts));
  CHECK_EQ(hal::motors_lines(), 0u);
}
