#include "firmtouch/field/distance_bounds.hpp"

#include <float.h>

#include "firmtouch/field/centre.hpp"

namespace firmtouch::field {
namespace {

using math::Vec3;

// Relative roundings: a difference has one, a square two of its own, sums two, the root half of all
// and one: below 4 units of 2^-24. Products and differences of the bounds take as many again.
constexpr float kUp = 1.0f + 8.0f * 0x1p-24f;
constexpr float kDown = 1.0f - 8.0f * 0x1p-24f;

// The cell on one axis; the nearest one if p is outside the grid or NaN.
uint32_t cell_on_axis(float cells, uint32_t count) {
  if (!(cells >= 1.0f)) return 0;
  if (cells >= static_cast<float>(static_cast<int32_t>(count))) return count - 1;
  return static_cast<uint32_t>(static_cast<int32_t>(cells));
}

float beside(float low, float high, float x) {
  const float below = low - x, above = x - high;
  const float gap = below > above ? below : above;
  return math::larger(gap, 0.0f);
}

}  // namespace

Bounds distance_bounds(const View& distance_field, Vec3 p_m) {
  const Head& head = distance_field.head();
  const float per_cell = 1.0f / head.cell_m;
  const uint32_t x = cell_on_axis((p_m.x - head.low_m[0]) * per_cell, head.count[0]);
  const uint32_t y = cell_on_axis((p_m.y - head.low_m[1]) * per_cell, head.count[1]);
  const uint32_t z = cell_on_axis((p_m.z - head.low_m[2]) * per_cell, head.count[2]);
  const uint32_t cell = (z * head.count[1] + y) * head.count[0] + x;
  const float way_m = math::length(p_m - centre_of(head, x, y, z)) * kUp;
  const Vec3 off{beside(head.low_m[0], high_on_axis(head, 0), p_m.x),
                 beside(head.low_m[1], high_on_axis(head, 1), p_m.y),
                 beside(head.low_m[2], high_on_axis(head, 2), p_m.z)};
  const float box_m = math::length(off) * kDown;

  Bounds bounds;
  bounds.seed = distance_field.seeds()[cell];
  bounds.upper_m = FLT_MAX;
  const int16_t word = distance_field.distances()[cell];
  if (word != kUnknown) {
    const float quanta = static_cast<float>(static_cast<int32_t>(quanta_of(word)));
    const float lower_m = (quanta * head.quantum_m - way_m) * kDown;
    const float upper_m =
        ((quanta + static_cast<float>(static_cast<int32_t>(kWide))) * head.quantum_m + way_m) * kUp;
    if (lower_m > 0.0f) bounds.lower_m = lower_m;
    if (upper_m <= FLT_MAX) bounds.upper_m = upper_m;
    if (lower_m > 0.0f && distance_field.is_signed())
      bounds.sign = word < 0 ? int8_t{-1} : int8_t{1};
  }
  if (box_m > 0.0f) {
    if (distance_field.is_signed()) bounds.sign = 1;
    // Squares overflow beyond 2^64 m: then no bound.
    if (box_m > bounds.lower_m && box_m <= FLT_MAX) bounds.lower_m = box_m;
  }
  return math::is_finite(p_m) ? bounds : Bounds{0, FLT_MAX, 0, query::kNowhere};
}

}  // namespace firmtouch::field
