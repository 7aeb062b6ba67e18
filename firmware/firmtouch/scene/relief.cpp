#include "firmtouch/scene/relief.hpp"

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::scene {
namespace {

constexpr float kCounts = 255;  // of a sample

math::Vec3 as_vec(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

float round(float value) { return (value + 0x1.8p23f) - 0x1.8p23f; }

// The three samples about a place along one side, their weights, and how these grow a sample.
struct Weights {
  uint32_t at[3];
  float weight[3], rise[3];
};

Weights weights_at(float tiles, uint32_t side) {
  float place = (tiles - round(tiles)) * static_cast<float>(side);
  // Where that is NaN, or too large for a fraction.
  if (!(__builtin_fabsf(place) <= static_cast<float>(side))) place = 0;
  const float nearest = round(place), off = place - nearest;
  const float less = 0.5f - off, more = 0.5f + off;
  const uint32_t middle = static_cast<uint32_t>(static_cast<int32_t>(nearest));
  const uint32_t last = side - 1;
  return {{(middle - 1) & last, middle & last, (middle + 1) & last},
          {0.5f * less * less, 0.75f - off * off, 0.5f * more * more},
          {-less, -2.0f * off, more}};
}

uint32_t size(int32_t a) { return static_cast<uint32_t>(a < 0 ? -a : a); }

void keep_most(uint32_t value, uint32_t& most) {
  if (value > most) most = value;
}

}  // namespace

void add_relief(const ReliefLayout& relief, const uint8_t* samples, math::Vec3 x_m, Cut& cut) {
  if (!(relief.height_m > 0.0f)) return;
  const math::Vec3 u_per_m = as_vec(relief.u_per_m), v_per_m = as_vec(relief.v_per_m);
  const Weights u = weights_at(math::dot(u_per_m, x_m), relief.side);
  const Weights v = weights_at(math::dot(v_per_m, x_m), relief.side);
  float depth = 0, along_u = 0, along_v = 0;
  for (uint32_t i = 0; i < 3; ++i) {
    const uint8_t* const row = samples + relief.first + v.at[i] * relief.side;
    float value = 0, rise = 0;
    for (uint32_t k = 0; k < 3; ++k) {
      const float sample = static_cast<float>(row[u.at[k]]);
      value += u.weight[k] * sample;
      rise += u.rise[k] * sample;
    }
    depth += v.weight[i] * value;
    along_u += v.weight[i] * rise;
    along_v += v.rise[i] * value;
  }
  const float count_m = relief.height_m * (1.0f / kCounts);
  const float per_tile_m = count_m * static_cast<float>(relief.side);
  cut.depth_m += count_m * depth;
  cut.slope = cut.slope + u_per_m * (per_tile_m * along_u) + v_per_m * (per_tile_m * along_v);
}

ReliefBounds bounds_of(const ReliefLayout& relief, const uint8_t* samples) {
  const uint8_t* const tile = samples + relief.first;
  const uint32_t side = relief.side, last = side - 1;
  uint32_t u = 0, v = 0, uu = 0, uv = 0, vv = 0;  // largest differences
  for (uint32_t i = 0; i < side; ++i)
    for (uint32_t k = 0; k < side; ++k) {
      const auto at = [&](uint32_t row, uint32_t column) {
        return static_cast<int32_t>(tile[(row & last) * side + (column & last)]);
      };
      const int32_t here = at(i, k), right = at(i, k + 1), below = at(i + 1, k);
      keep_most(size(right - here), u);
      keep_most(size(below - here), v);
      keep_most(size(right - 2 * here + at(i, k - 1)), uu);
      keep_most(size(below - 2 * here + at(i - 1, k)), vv);
      keep_most(size(at(i + 1, k + 1) - right - below + here), uv);
    }
  const float u_per_m = math::length(as_vec(relief.u_per_m)) * static_cast<float>(side);
  const float v_per_m = math::length(as_vec(relief.v_per_m)) * static_cast<float>(side);
  const float count_m = relief.height_m * (1.0f / kCounts);
  const auto wide = [](uint32_t value) { return static_cast<float>(value); };
  return {count_m * (wide(u) * u_per_m + wide(v) * v_per_m),
          count_m * (wide(uu) * u_per_m * u_per_m + 2.0f * wide(uv) * u_per_m * v_per_m +
                     wide(vv) * v_per_m * v_per_m)};
}

}  // namespace firmtouch::scene
