#include "firmtouch/record/ring.hpp"

#include "harness/test.hpp"

namespace firmtouch::record {
namespace {

struct Item {
  uint32_t value = 0;
  uint32_t inverse = 0;  // a torn copy would not fit
};
Item item(uint32_t value) { return {value, ~value}; }
bool is_whole(const Item& item) { return item.inverse == ~item.value; }

TEST(Ring_RecordsComeOutCompleteAndInOrder) {
  Ring<Item, 8> ring;
  Numbered<Item> out[8];
  uint32_t next = 0;
  for (uint32_t round = 0; round < 100; ++round) {
    const uint32_t batch = round % 8 + 1;
    for (uint32_t i = 0; i < batch; ++i) CHECK(ring.push(item(1000 + next + i)));
    CHECK_EQ(ring.waiting(), batch);
    CHECK_EQ(ring.pop(out), batch);
    for (uint32_t i = 0; i < batch; ++i, ++next) {
      CHECK_EQ(out[i].number, next);
      CHECK_EQ(out[i].value.value, 1000 + next);
      CHECK(is_whole(out[i].value));
    }
  }
  CHECK_EQ(ring.pop(out), 0u);
}

TEST(Ring_Full_DropsAndCountsTheNewest) {
  Ring<Item, 4> ring;
  for (uint32_t i = 0; i < 4; ++i) CHECK(ring.push(item(i)));
  for (uint32_t i = 4; i < 11; ++i) CHECK(!ring.push(item(i)));
  CHECK_EQ(ring.dropped(), 7u);
  CHECK_EQ(ring.produced(), 11u);
  Numbered<Item> out[4];
  CHECK_EQ(ring.pop(out), 4u);
  for (uint32_t i = 0; i < 4; ++i) CHECK_EQ(out[i].value.value, i);
  CHECK_EQ(ring.produced(), ring.consumed() + ring.waiting() + ring.dropped());
}

TEST(Ring_Numbers_ShowWhereRecordsAreMissing) {
  Ring<Item, 2> ring;
  Numbered<Item> out[2];
  for (uint32_t i = 0; i < 5; ++i) ring.push(item(i));  // 2, 3, 4 are lost
  CHECK_EQ(ring.pop({out, 1}), 1u);
  CHECK(ring.push(item(5)));
  CHECK(!ring.push(item(6)));
  CHECK_EQ(ring.pop(out), 2u);
  CHECK_EQ(out[0].number, 1u);
  CHECK_EQ(out[1].number, 5u);
  CHECK(ring.push(item(7)));
  CHECK_EQ(ring.pop(out), 1u);
  CHECK_EQ(out[0].number, 7u);
}

TEST(Ring_WrappedIndices_LoseNothing) {
  Ring<Item, 4> ring(0xFFFFFFFDu);
  Numbered<Item> out[4];
  for (uint32_t i = 0; i < 4; ++i) CHECK(ring.push(item(i)));
  CHECK(!ring.push(item(4)));
  CHECK_EQ(ring.pop(out), 4u);
  for (uint32_t i = 0; i < 4; ++i) CHECK_EQ(out[i].number, 0xFFFFFFFDu + i);
  CHECK_EQ(ring.waiting(), 0u);
  for (uint32_t i = 0; i < 9; ++i) {
    CHECK(ring.push(item(i)));
    CHECK_EQ(ring.pop(out), 1u);
    CHECK_EQ(out[0].value.value, i);
  }
}

TEST(Ring_ReadyRecords_StayUntilRelease) {
  Ring<Item, 4> ring;
  for (uint32_t i = 0; i < 3; ++i) ring.push(item(i));
  CHECK_EQ(ring.ready().size(), 3u);
  CHECK_EQ(ring.ready().size(), 3u);
  ring.release(2);
  CHECK_EQ(ring.ready().size(), 1u);
  ring.push(item(3));
  ring.push(item(4));
  CHECK_EQ(ring.ready().size(), 2u);  // to the end of the memory
  ring.release(2);
  CHECK_EQ(ring.ready().size(), 1u);  // from its beginning
  CHECK_EQ(ring.ready()[0].value.value, 4u);
}

// Oracle: a plain list. The reader's steps, with 0 to 5 whole pushes in every gap between two
// steps.
struct Enumeration {
  Ring<Item, 4> ring;
  uint32_t pushed = 0;
  uint32_t kept[32] = {};
  uint32_t kept_count = 0;
  uint32_t read_count = 0;
  uint32_t dropped = 0;

  void interrupt(uint32_t pushes) {
    for (uint32_t i = 0; i < pushes; ++i, ++pushed) {
      const bool has_room = kept_count - read_count < 4;
      CHECK_EQ(ring.push(item(pushed)), has_room);
      if (has_room) {
        kept[kept_count++] = pushed;
      } else {
        ++dropped;
      }
    }
  }
  void check_read(const Numbered<Item>& got, uint32_t offset) {
    CHECK(read_count + offset < kept_count);
    CHECK_EQ(got.value.value, kept[read_count + offset]);
    CHECK_EQ(got.number, kept[read_count + offset]);
    CHECK(is_whole(got.value));
  }
};

void enumerate(uint32_t code) {
  Enumeration all;
  uint32_t gap[6];
  for (uint32_t& pushes : gap) {
    pushes = code % 6;
    code /= 6;
  }
  all.interrupt(gap[0]);
  for (uint32_t round = 0; round < 2; ++round) {
    const core::Span<const Numbered<Item>> ready = all.ring.ready();
    all.interrupt(gap[1]);
    Numbered<Item> copy[4];
    for (uint32_t i = 0; i < ready.size(); ++i) {
      copy[i].number = ready[i].number;
      all.interrupt(i == 0 ? gap[2] : 0);
      copy[i].value.value = ready[i].value.value;
      all.interrupt(i == 0 ? gap[3] : 0);
      copy[i].value.inverse = ready[i].value.inverse;
    }
    all.interrupt(gap[4]);
    for (uint32_t i = 0; i < ready.size(); ++i) all.check_read(copy[i], i);
    all.read_count += ready.size();
    all.ring.release(ready.size());
    all.interrupt(gap[5]);
    CHECK_EQ(all.ring.waiting(), all.kept_count - all.read_count);
    CHECK_EQ(all.ring.dropped(), all.dropped);
    CHECK_EQ(all.ring.produced(), all.pushed);
  }
}

TEST(Ring_InterruptBetweenAnyReaderSteps_LosesNothing) {
  for (uint32_t code = 0; code < 6 * 6 * 6 * 6 * 6 * 6; ++code) {
    test::note("code", code);
    enumerate(code);
  }
}

}  // namespace
}  // namespace firmtouch::record
