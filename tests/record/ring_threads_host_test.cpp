#include <cstdlib>
#include <thread>

#include "firmtouch/record/ring.hpp"
#include "firmtouch/record/tick.hpp"
#include "harness/test.hpp"

namespace firmtouch::record {
namespace {

constexpr uint32_t kTransfers = 300000;

TickRecord filled(uint32_t number) {
  TickRecord made{};
  made.input.tick = number;
  made.input.command = number ^ 0xA5A5A5A5u;
  made.output.model_sequence = ~number;  // the last word: a torn copy would not fit
  return made;
}

// `pace`: records that the producer makes before the reader runs; a large pace overruns the ring.
void stream(uint32_t pace) {
  static Ring<TickRecord, 64> ring;
  const uint32_t begin_produced = ring.produced();
  const uint32_t begin_dropped = ring.dropped();
  const uint32_t begin_consumed = ring.consumed();
  bool is_done = false;

  std::thread producer([&] {
    for (uint32_t i = 0; i < kTransfers; ++i) {
      ring.push(filled(begin_produced + i));
      if (i % pace == 0) std::this_thread::yield();
    }
    __atomic_store_n(&is_done, true, __ATOMIC_RELEASE);
  });

  Numbered<TickRecord> batch[16];
  uint32_t bad = 0;
  uint32_t got = 0;
  uint32_t missing = 0;
  uint32_t next = begin_produced;
  for (;;) {
    const bool was_done = __atomic_load_n(&is_done, __ATOMIC_ACQUIRE);
    const uint32_t count = ring.pop(batch);
    for (uint32_t i = 0; i < count; ++i) {
      const TickRecord expected = filled(batch[i].number);
      missing += batch[i].number - next;
      next = batch[i].number + 1;
      if (__builtin_memcmp(&expected, &batch[i].value, sizeof expected) != 0) ++bad;
    }
    got += count;
    if (count == 0) {
      if (was_done) break;
      std::this_thread::yield();
    }
  }
  producer.join();
  missing += ring.produced() - next;  // those lost at the very end

  CHECK_EQ(bad, 0u);
  CHECK_EQ(ring.consumed() - begin_consumed, got);
  CHECK_EQ(ring.dropped() - begin_dropped, missing);
  CHECK_EQ(ring.produced() - begin_produced, kTransfers);
  CHECK_EQ(ring.produced(), ring.consumed() + ring.dropped());
}

// Many small records.
TEST(Ring_TwoThreads_MillionsOfSmallRecordsArriveComplete) {
  struct Small {
    uint32_t value = 0, inverse = 0;
  };
  static Ring<Small, 1024> ring;
  const uint32_t transfers = std::getenv("FIRMTOUCH_LONG") != nullptr ? 1000000000 : 2000000;
  std::thread producer([&] {
    for (uint32_t kept = 0; kept < transfers;) {
      const uint32_t number = ring.produced();
      if (ring.push({number, ~number}))
        ++kept;
      else
        std::this_thread::yield();
    }
  });
  Numbered<Small> batch[256];
  uint32_t bad = 0, got = 0, missing = 0, next = 0;
  while (got < transfers) {
    const uint32_t count = ring.pop(batch);
    for (uint32_t i = 0; i < count; ++i) {
      missing += batch[i].number - next;
      next = batch[i].number + 1;
      if (batch[i].value.value != batch[i].number || batch[i].value.inverse != ~batch[i].number)
        ++bad;
    }
    got += count;
    if (count == 0) std::this_thread::yield();
  }
  producer.join();
  test::note("transfers", transfers);
  CHECK_EQ(bad, 0u);
  CHECK_EQ(ring.consumed(), got);
  CHECK_EQ(ring.produced(), ring.consumed() + ring.dropped());
  CHECK_EQ(missing + (ring.produced() - next), ring.dropped());
}

TEST(Ring_TwoThreads_EveryRecordIsCompleteOrCountedAsDropped) {
  constexpr uint32_t kPaces[] = {16, 64, 1000, kTransfers + 1};
  for (const uint32_t pace : kPaces) {
    test::note("pace", pace);
    stream(pace);
  }
}

}  // namespace
}  // namespace firmtouch::record
