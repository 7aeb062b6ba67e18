// Entries of the wide search are ordered and replaced without branches, and boxes measured by fours
// and sixes, as the portable definitions do.
#include "simd/search/entries.hpp"

#include "harness/random.hpp"
#include "harness/test.hpp"
#include "simd/search/boxes.hpp"

namespace math = firmtouch::math;
namespace simd = firmtouch::simd;

namespace {

firmtouch::test::Xorshift next_random(11);
uint64_t any_word() {
  const uint64_t low = next_random();
  return next_random() % 5 == 0 ? UINT64_MAX : uint64_t{next_random()} << 32 | low;
}

void fill(simd::Entry& w) { w = {any_word(), any_word()}; }
void fill(simd::ChildEntry& w) { w = {any_word(), any_word(), any_word()}; }
bool is_same(const simd::Entry& a, const simd::Entry& b) {
  return a.key == b.key && a.keys == b.keys;
}
bool is_same(const simd::ChildEntry& a, const simd::ChildEntry& b) {
  return a.key == b.key && a.keys == b.keys && a.child == b.child;
}

// Calls `moves(i, a, b)` for random pairs. It must return true for more than 200.
template <class Any, class Moves>
void check_pairs(Moves moves) {
  uint32_t moved = 0;
  for (uint32_t i = 0; i < 4000; ++i) {
    Any a, b;
    fill(a);
    fill(b);
    moved += moves(i, a, b) ? 1u : 0u;
  }
  CHECK_LT(200u, moved);
}

template <class Any>
void compare_replaced() {
  check_pairs<Any>([](uint32_t i, const Any& a, const Any& b) {
    const uint64_t cutoff = i % 3 == 0 ? a.key : any_word();
    Any now = a;
    simd::replace_beyond(cutoff, now, b);
    CHECK(is_same(now, a.key > cutoff ? b : a));
    return !is_same(now, a);
  });
}

void put_random_pair(uint32_t (&pair)[8], bool is_whole) {
  for (uint32_t& word : pair) {
    const uint32_t a = next_random() & 0x7FFFu, b = next_random() & 0x7FFFu;
    word = (a < b ? a : b) | (32767u - (a < b ? b : a)) << 16;
    if (is_whole) word = 0;
  }
  pair[3] = pair[7] = next_random();  // children
}
void put_random_point(uint32_t (&at)[3]) {
  for (uint32_t& word : at) {
    const uint32_t x = next_random() & 0x7FFFu;
    word = (x + (x < 32767u ? 1u : 0u)) | (32767u - x) << 16;
  }
}

}  // namespace

TEST(ReplacedEntry_KeepsItsKeysAndChild) {
  compare_replaced<simd::Entry>();
  compare_replaced<simd::ChildEntry>();
}

TEST(OrderedEntries_KeepTheirKeysAndChildren) {
  check_pairs<simd::ChildEntry>([](uint32_t i, simd::ChildEntry a, simd::ChildEntry b) {
    if (i % 7 == 0) b.key = a.key;
    simd::ChildEntry first = a, second = b, expected_first = a, expected_second = b;
    simd::order(first, second);
    simd::portable_order(expected_first, expected_second);
    CHECK(is_same(first, expected_first) && is_same(second, expected_second));
    CHECK(is_same(first, a) ? is_same(second, b) : is_same(first, b) && is_same(second, a));
    CHECK(first.key <= second.key);
    if (i % 7 == 0) CHECK(is_same(first, a));
    return !is_same(first, a);
  });
}

TEST(NearerEntryFirst_EqualOnesKeepTheirOrder) {
  check_pairs<simd::Entry>([](uint32_t i, simd::Entry a, simd::Entry b) {
    const uint32_t key = next_random(), other = i % 7 == 0 ? key : next_random();
    simd::Entry first = a, second = b, expected_first = a, expected_second = b;
    simd::put_nearer_first(simd::keys_of(key, other), first, second);
    simd::portable_put_nearer_first(simd::keys_of(key, other), expected_first, expected_second);
    CHECK(is_same(first, expected_first) && is_same(second, expected_second));
    CHECK(is_same(first, other < key ? b : a) && is_same(second, other < key ? a : b));
    return !is_same(first, a);
  });
}

TEST(FourBoxDistances_EqualThoseOfEachBox) {
  uint32_t differ = 0, inside = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    uint32_t boxes[2][8];
    for (auto& pair : boxes) put_random_pair(pair, i % 9 == 0);
    uint32_t at[3];
    put_random_point(at);
    const math::BoxPoint point = math::box_point(at[0], at[1], at[2]);
    uint64_t reported[2];
    simd::sibling_distances2(boxes[0], boxes[1], point, reported[0], reported[1]);
    for (uint32_t pair = 0; pair < 2; ++pair) {
      const uint32_t first = math::portable::box_distance2(boxes[pair], at),
                     second = math::portable::box_distance2(boxes[pair] + 4, at);
      if (reported[pair] != simd::keys_of(first, second)) ++differ;
      inside += first == 0 ? 1 : 0;
    }
  }
  CHECK_EQ(differ, 0u);
  CHECK_LT(4000u, inside);
}

TEST(SixBoxesBelow_EqualTheComparisonOfEachBox) {
  uint32_t differ = 0, nearer = 0;
  for (uint32_t i = 0; i < 20000; ++i) {
    uint32_t boxes[3][8], at[3];
    for (auto& pair : boxes) put_random_pair(pair, i % 9 == 0);
    put_random_point(at);
    const uint32_t* const as = boxes[next_random() % 3] + 4 * (next_random() % 2);
    const uint32_t below = math::portable::box_distance2(as, at) + next_random() % 3 - (i % 2);
    const uint32_t reported =
        simd::boxes_below(boxes[0], boxes[1], math::box_point(at[0], at[1], at[2]), below);
    for (uint32_t k = 0; k < 6; ++k) {
      const bool is = math::portable::box_distance2(boxes[k / 2] + 4 * (k % 2), at) < below;
      differ += is == ((reported >> (k / 2 + 4 * (k % 2)) & 1u) != 0) ? 0u : 1u;
      nearer += is ? 1u : 0u;
    }
  }
  CHECK_EQ(differ, 0u);
  CHECK_LT(20000u, nearer);
}
