// Instructions of push() of the record ring: a tick's record into a ring that is empty, partly
// full, full, just emptied, or never read. A row a state:
//     STATE MIN MAX      instructions of the whole push()
// `copy` is the copy of the record alone. tools/bench/ring-cortex-m7 runs it.
#include <stdint.h>

#include "firmtouch/hal/board.hpp"
#include "firmtouch/hal/clock.hpp"
#include "firmtouch/record/ring.hpp"
#include "firmtouch/record/tick.hpp"
#include "target/count.hpp"

using namespace firmtouch;  // NOLINT: a program of the tests

namespace {

constexpr uint32_t kCapacity = 64;
constexpr uint32_t kTimes = 256;
using Ring = record::Ring<record::TickRecord, kCapacity>;

Ring ring;
record::Numbered<record::TickRecord> slot;
record::TickRecord now;

[[gnu::noinline]] bool push() {
  asm volatile("" ::"r"(&now) : "memory");
  return ring.push(now);
}
[[gnu::noinline]] bool copy() {
  asm volatile("" ::"r"(&slot), "r"(&now) : "memory");  // both may be read and written elsewhere
  slot.value = now;
  asm volatile("" ::: "memory");
  return true;
}
[[gnu::noinline]] bool nothing() {
  asm volatile("" ::: "memory");
  return true;
}

uint32_t ticks_of(bool (*work)()) {
  const uint32_t before = hal::clock_work();
  work();
  return hal::clock_work() - before;
}

// Of the same call of an empty function: what is left is the work's own.
uint32_t instructions(uint32_t ticks, uint32_t empty_ticks) {
  const uint32_t per_1000 = hal::clock_work_per_1000();
  const uint32_t own = ticks > empty_ticks ? ticks - empty_ticks : 0;
  return static_cast<uint32_t>((uint64_t{own} * 1000 + per_1000 - 1) / per_1000);
}

void drain() { ring.release(ring.ready().size()), ring.release(ring.ready().size()); }

void measure(const char* state, bool (*work)(), void (*prepare)()) {
  uint32_t least = UINT32_MAX, most = 0, empty = UINT32_MAX;
  for (uint32_t i = 0; i < kTimes; ++i) {
    const uint32_t ticks = ticks_of(nothing);
    if (ticks < empty) empty = ticks;
  }
  for (uint32_t i = 0; i < kTimes; ++i) {
    prepare();
    const uint32_t taken = instructions(ticks_of(work), empty);
    if (taken < least) least = taken;
    if (taken > most) most = taken;
  }
  hal::board_print(state);
  target::print(" ", least);
  target::print(" ", most);
  hal::board_print("\n");
}

void fill() {
  while (ring.waiting() < kCapacity) ring.push(now);
}

}  // namespace

int main() {
  hal::board_begin();
  measure("copy", copy, [] {});
  measure("empty", push, drain);
  measure("waiting", push, [] {
    if (ring.waiting() > kCapacity / 2) drain();
  });
  measure("just-emptied", push, [] {
    fill();
    drain();
  });
  measure("full", push, fill);
  measure("reader-dead", push, [] {});
  return 0;
}
