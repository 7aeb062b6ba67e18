// Eight floats at once are compared, selected and minimised as each alone.
#include "simd/search/vectors.hpp"

#include <stdint.h>

#include "harness/test.hpp"

namespace math = firmtouch::math;
namespace simd = firmtouch::simd;

namespace {

uint32_t g_seed = 3;
uint32_t next_random() {
  g_seed ^= g_seed << 13, g_seed ^= g_seed >> 17, g_seed ^= g_seed << 5;
  return g_seed;
}

constexpr uint32_t kSpecials[] = {0x00000000u, 0x80000000u, 0x00000001u, 0x807FFFFFu, 0x3F7FFFFFu,
                                  0x3F800000u, 0x3F800001u, 0xBF800000u, 0x7F7FFFFFu, 0x7F800000u,
                                  0xFF800000u, 0x7FC00000u, 0xFFC00000u, 0x7F800001u};
float any_float(bool is_special) {
  return math::float_of(is_special ? kSpecials[next_random() % 14] : next_random());
}

uint32_t comparisons_that_differ(bool is_special) {
  constexpr uint32_t kLanes = 8;
  float a[kLanes], b[kLanes];
  for (uint32_t k = 0; k < kLanes; ++k) {
    a[k] = any_float(is_special);
    b[k] = next_random() % 4 == 0 ? a[k] : any_float(is_special);
  }
  const simd::Float8 x = simd::lanes_from(a), y = simd::lanes_from(b);
  const simd::Mask8 less = simd::less(x, y), at_most = simd::at_most(x, y);
  const simd::Float8 chosen = simd::select(less, x, y);
  const simd::Float8 larger = simd::larger(x, y), smaller = simd::smaller(x, y);
  const simd::Mask8 mask = simd::select(less, at_most, ~at_most);
  uint32_t differ = 0;
  for (uint32_t k = 0; k < kLanes; ++k) {
    const bool is_less = a[k] < b[k], is_at_most = a[k] <= b[k];
    if (((simd::bits_of(less) >> k) & 1u) != (is_less ? 1u : 0u)) ++differ;
    if (((simd::bits_of(at_most) >> k) & 1u) != (is_at_most ? 1u : 0u)) ++differ;
    if (math::bits_of(simd::lane_of(chosen, k)) != math::bits_of(is_less ? a[k] : b[k])) ++differ;
    if (math::bits_of(simd::lane_of(larger, k)) != math::bits_of(a[k] > b[k] ? a[k] : b[k]))
      ++differ;
    if (math::bits_of(simd::lane_of(smaller, k)) != math::bits_of(is_less ? a[k] : b[k])) ++differ;
    if ((simd::lane_of(mask, k) != 0) != (is_less ? is_at_most : !is_at_most)) ++differ;
  }
  if ((simd::bits_of(less) >> kLanes) != 0) ++differ;
  return differ;
}

// Of squares, some equal, in any lanes.
uint32_t minima_that_differ() {
  constexpr uint32_t kLanes = 8;
  float v[kLanes];
  for (uint32_t k = 0; k < kLanes; ++k)
    v[k] = next_random() % 3 == 0 ? static_cast<float>(next_random() % 3)
                                  : math::float_of(next_random() % 0x7F7FFFFFu);
  uint32_t of = next_random() & ((1u << kLanes) - 1u);
  of |= of == 0 ? 1u << next_random() % kLanes : 0u;
  for (uint32_t k = 0; k < kLanes; ++k)  // the other lanes hold anything
    if (((of >> k) & 1u) == 0) v[k] = any_float(true);
  uint32_t expected = kLanes;
  for (uint32_t k = kLanes; k-- > 0;)
    if (((of >> k) & 1u) != 0 && (expected == kLanes || v[k] <= v[expected])) expected = k;
  const simd::Float8 lanes = simd::lanes_from(v);
  float least = -1;
  uint32_t differ = simd::minimum_lane(lanes, of, least) == expected ? 0u : 1u;
  if (math::bits_of(least) != math::bits_of(v[expected])) ++differ;
  if (math::bits_of(simd::minimum_of(lanes, of)) != math::bits_of(v[expected])) ++differ;
  if (!(simd::minimum_of(lanes, 0) >= simd::kMaxMinimum)) ++differ;
  return differ;
}

}  // namespace

TEST(Lanes_CompareAndSelectLikeOneFloat) {
  uint32_t differ = 0;
  for (uint32_t i = 0; i < 4000; ++i) {
    differ += comparisons_that_differ(i % 3 == 0);
  }
  CHECK_EQ(differ, 0u);
}

TEST(MinimumLane_IsTheFirstThatHoldsIt) {
  uint32_t differ = 0;
  for (uint32_t i = 0; i < 8000; ++i) {
    differ += minima_that_differ();
  }
  CHECK_EQ(differ, 0u);
}
