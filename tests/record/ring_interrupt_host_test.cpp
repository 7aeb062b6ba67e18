#include "firmtouch/record/ring.hpp"
#include "harness/single_step.hpp"
#include "harness/test.hpp"

// Single-steps the machine code of pop(), with a whole interrupt between any two instructions.
#if defined(FIRMTOUCH_SINGLE_STEP)

namespace firmtouch::record {
namespace {

struct Item {
  uint32_t value = 0;
  uint32_t inverse = 0;
};
using SmallRing = Ring<Item, 4>;

SmallRing* g_ring;
uint32_t g_interrupt_pushes;
uint32_t g_pushed;

void push_next() {
  g_ring->push({g_pushed, ~g_pushed});
  ++g_pushed;
}

void interrupt() {
  for (uint32_t i = 0; i < g_interrupt_pushes; ++i) push_next();
}

// Result: false if the interrupt's position is beyond the end of pop().
bool try_one(test::SingleStep& step, uint32_t waiting, uint32_t turned, uint32_t place,
             uint32_t pushes) {
  SmallRing ring;
  g_ring = &ring;
  g_pushed = 0;
  Numbered<Item> out[8];
  for (uint32_t i = 0; i < turned; ++i) {  // so that a batch lies across the end of the memory
    push_next();
    ring.pop(out);
  }
  for (uint32_t i = 0; i < waiting; ++i) push_next();
  g_interrupt_pushes = pushes;
  uint32_t count = 0;
  const bool happened = step.run(place, interrupt, [&] { count = ring.pop({out, 4}); });

  uint32_t next = turned;
  uint32_t missing = 0;
  const uint32_t rest = ring.pop({out + count, 4});
  for (uint32_t i = 0; i < count + rest; ++i) {
    missing += out[i].number - next;
    next = out[i].number + 1;
    CHECK_EQ(out[i].value.value, out[i].number);
    CHECK_EQ(out[i].value.inverse, ~out[i].number);
  }
  missing += ring.produced() - next;
  CHECK_EQ(missing, ring.dropped());
  CHECK_EQ(ring.produced(), g_pushed);
  CHECK_EQ(ring.produced(), ring.consumed() + ring.dropped());
  CHECK_GE(count, waiting);
  return happened;
}

TEST(Pop_InterruptBetweenAnyInstructions_LosesNothing) {
  test::SingleStep step;
  CHECK(step.is_ready());
  uint32_t places = 0;
  for (uint32_t waiting = 0; waiting <= 4; ++waiting) {
    for (uint32_t turned = 0; turned < 4; turned += 3) {
      for (uint32_t pushes = 1; pushes <= 5; pushes += 4) {
        uint32_t place = 0;
        while (try_one(step, waiting, turned, place, pushes)) {
          // All places of optimised code; samples of what sanitizers make of it, which is longer.
          place += place < 200 ? 1 : place / 4;
          ++places;
        }
      }
    }
  }
  CHECK_GE(places, 10u * 2u * 10u);  // single stepping did happen
}

}  // namespace
}  // namespace firmtouch::record

#endif
