// Floats side by side are compared, chosen and gathered as each alone would be.
#include "firmtouch/math/isa_lanes.hpp"

#include <stdint.h>

#include "harness/random.hpp"
#include "harness/test.hpp"

namespace math = firmtouch::math;

namespace {

firmtouch::test::Xorshift next_random(3);

constexpr uint32_t kSpecials[] = {0x00000000u, 0x80000000u, 0x00000001u, 0x807FFFFFu, 0x3F7FFFFFu,
                                  0x3F800000u, 0x3F800001u, 0xBF800000u, 0x7F7FFFFFu, 0x7F800000u,
                                  0xFF800000u, 0x7FC00000u, 0xFFC00000u, 0x7F800001u};
float any_float(bool is_special) {
  return math::float_of(is_special ? kSpecials[next_random() % 14] : next_random());
}

template <class Float>
uint32_t comparisons_that_differ(bool is_special) {
  constexpr uint32_t kLanes = math::kLanesOf<Float>;
  float a[kLanes], b[kLanes];
  Float x, y;
  for (uint32_t k = 0; k < kLanes; ++k) {
    a[k] = any_float(is_special);
    b[k] = next_random() % 4 == 0 ? a[k] : any_float(is_special);
    x[k] = a[k], y[k] = b[k];
  }
  const auto less = math::less(x, y), at_most = math::at_most(x, y);
  const Float chosen = math::select(less, x, y);
  const Float larger = math::larger(x, y), smaller = math::smaller(x, y);
  const auto mask = math::select(less, at_most, ~at_most);
  uint32_t differ = 0;
  for (uint32_t k = 0; k < kLanes; ++k) {
    const bool is_less = a[k] < b[k], is_at_most = a[k] <= b[k];
    if (((math::lanes_of(less) >> k) & 1u) != (is_less ? 1u : 0u)) ++differ;
    if (((math::lanes_of(at_most) >> k) & 1u) != (is_at_most ? 1u : 0u)) ++differ;
    if (math::bits_of(chosen[k]) != math::bits_of(is_less ? a[k] : b[k])) ++differ;
    if (math::bits_of(larger[k]) != math::bits_of(a[k] > b[k] ? a[k] : b[k])) ++differ;
    if (math::bits_of(smaller[k]) != math::bits_of(is_less ? a[k] : b[k])) ++differ;
    if ((mask[k] != 0) != (is_less ? is_at_most : !is_at_most)) ++differ;
  }
  if ((math::lanes_of(less) >> kLanes) != 0) ++differ;
  return differ;
}

// Of squares, some equal, of which every lane but one may be asked.
template <class Float>
uint32_t minima_that_differ() {
  constexpr uint32_t kLanes = math::kLanesOf<Float>;
  Float v;
  for (uint32_t k = 0; k < kLanes; ++k)
    v[k] = next_random() % 3 == 0 ? static_cast<float>(next_random() % 3)
                                  : math::float_of(next_random() % 0x7F7FFFFFu);
  uint32_t of = next_random() & ((1u << kLanes) - 1u);
  of |= of == 0 ? 1u << next_random() % kLanes : 0u;
  for (uint32_t k = 0; k < kLanes; ++k)  // what is not asked may be anything
    if (((of >> k) & 1u) == 0) v[k] = any_float(true);
  uint32_t expected = kLanes;
  for (uint32_t k = kLanes; k-- > 0;)
    if (((of >> k) & 1u) != 0 && (expected == kLanes || v[k] <= v[expected])) expected = k;
  float least = -1, portable_least = -1;
  uint32_t differ = math::min_lane(v, of, least) == expected ? 0u : 1u;
  if (math::portable_least_lane(v, of, portable_least) != expected) ++differ;
  if (math::bits_of(least) != math::bits_of(v[expected])) ++differ;
  if (math::bits_of(math::least_of(v, of)) != math::bits_of(v[expected])) ++differ;
  if (!(math::least_of(v, 0) >= math::kMaxLeast)) ++differ;
  if (math::bits_of(portable_least) != math::bits_of(v[expected])) ++differ;
  return differ;
}

template <class Float>
uint32_t gathered_that_differ() {
  constexpr uint32_t kLanes = math::kLanesOf<Float>;
  float places[24];
  for (float& place : places) place = math::float_of(next_random());
  uint32_t at[kLanes];
  for (uint32_t& place : at) place = next_random() % 22;
  at[next_random() % kLanes] = 21;  // the last three
  math::Lanes<Float> v;
  if constexpr (kLanes == 8)
    v = math::gather(places + at[0], places + at[1], places + at[2], places + at[3], places + at[4],
                     places + at[5], places + at[6], places + at[7]);
  else
    v = math::gather(places + at[0], places + at[1], places + at[2], places + at[3]);
  uint32_t differ = 0;
  for (uint32_t k = 0; k < kLanes; ++k) {
    if (math::bits_of(v.x[k]) != math::bits_of(places[at[k]]) ||
        math::bits_of(v.y[k]) != math::bits_of(places[at[k] + 1]) ||
        math::bits_of(v.z[k]) != math::bits_of(places[at[k] + 2]))
      ++differ;
  }
  return differ;
}

}  // namespace

TEST(LanesCompareAndChooseLikeOneFloat) {
  uint32_t differ = 0;
  for (uint32_t i = 0; i < 4000; ++i) {
    differ += comparisons_that_differ<math::Float4>(i % 3 == 0);
    differ += comparisons_that_differ<math::FloatWide>(i % 3 == 0);
  }
  CHECK_EQ(differ, 0u);
}

TEST(LanesGatherThreeFloatsAndReadNoneBehind) {
  uint32_t differ = 0;
  for (uint32_t i = 0; i < 4000; ++i)
    differ += gathered_that_differ<math::Float4>() + gathered_that_differ<math::FloatWide>();
  CHECK_EQ(differ, 0u);
}

TEST(TheLeastOfLanesIsTheFirstThatHoldsIt) {
  uint32_t differ = 0;
  for (uint32_t i = 0; i < 8000; ++i) {
    differ += minima_that_differ<math::Float4>();
    differ += minima_that_differ<math::FloatWide>();
  }
  CHECK_EQ(differ, 0u);
}
