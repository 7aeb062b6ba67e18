// A board of its own: start-up, console, servo timer.
#include "firmtouch/hal/board.hpp"

#include "firmtouch/hal/clock.hpp"
#include "firmtouch/hal/motors.hpp"

using Handler = void (*)();

int main();
extern "C" {
extern uint32_t stack_top[], data[], data_end[], data_load[], bss[], bss_end[];
extern Handler constructors[], constructors_end[];
extern const unsigned char scene_fta[];
extern const unsigned scene_fta_size;
}

namespace {

constexpr uint32_t kCore_MHz = 25;
void (*on_tick)() = nullptr;
uint32_t ticks = 0;

volatile uint32_t& at(uint32_t address) { return *reinterpret_cast<volatile uint32_t*>(address); }

[[noreturn]] void start() {
  const uint32_t* from = data_load;
  for (volatile uint32_t* to = data; to < data_end; ++to) *to = *from++;
  for (volatile uint32_t* to = bss; to < bss_end; ++to) *to = 0;
  for (Handler* make = constructors; make < constructors_end; ++make) (*make)();
  firmtouch::hal::board_exit(main());
}

void fault() {
  firmtouch::hal::motors_off();
  firmtouch::hal::board_exit(70);
}

void timer() {
  ++ticks;
  if (on_tick != nullptr) on_tick();
}

}  // namespace

extern "C" [[gnu::naked]] void reset() {
  asm volatile(
      "ldr r0, =0xE000ED88\n ldr r1, [r0]\n orr r1, #0xF00000\n str r1, [r0]\n dsb\n isb\n bx %0" ::
          "r"(start));
}

[[gnu::section(".vectors"), gnu::used]] const Handler vectors[16] = {
    reinterpret_cast<Handler>(stack_top),
    reset,
    fault,
    fault,
    fault,
    fault,
    fault,
    nullptr,
    nullptr,
    nullptr,
    nullptr,
    fault,
    fault,
    nullptr,
    fault,
    timer};

namespace firmtouch::hal {

void board_begin() {
  at(0x40004010) = kCore_MHz * 1000000 / 115200;
  at(0x40004008) = 1;
}

const char* board_name() { return "consumer"; }
core::Bytes board_asset() { return {scene_fta, scene_fta_size}; }

void board_print(const char* text) {
  for (; *text != 0; ++text) {
    while ((at(0x40004004) & 1) != 0) {
    }
    at(0x40004000) = static_cast<uint8_t>(*text);
  }
}

void board_exit(int status) {
  asm volatile("cpsid i" ::: "memory");
  motors_off();
  const uint32_t block[] = {0x20026, static_cast<uint32_t>(status)};
  asm volatile("mov r0, #0x20\n mov r1, %0\n bkpt 0xAB" ::"r"(block) : "r0", "r1", "memory");
  for (;;) asm volatile("wfi");
}

uint32_t clock_us() { return ticks * 1000; }

void clock_start_servo(uint32_t period_us, void (*tick)()) {
  on_tick = tick;
  at(0xE000E014) = period_us * kCore_MHz - 1;
  at(0xE000E018) = 0;
  at(0xE000E010) = 7;
}

}  // namespace firmtouch::hal
