#include "firmtouch/hull/base_hull_segment.hpp"

namespace firmtouch::hull {
namespace {

float absolute(float v) { return v < 0.0f ? -v : v; }
// NaN: the lower end.
float within(float v, float low, float high) { return !(v > low) ? low : v < high ? v : high; }

// Distances along an axis that floats hold with room for products, as hull::Slabs.
constexpr float kStill_m = 1e-30f, kFar_m = 1e30f, kPad_m = 4e-30f;
// Of a position on the axis, in 256ths of the box: what the quotient loses.
constexpr float kPositionError = 0x1p-10f;
// Of a time, in units of 1 / kEnd: 255 times a rate that is less than 1.25 off, and sums of up to
// 2^30 in floats, 64 each.
constexpr float kTimeSlack = 1024.0f;
// Of a corner beside the line, in steps of the grid's upper 16 bits: 2^-13 of the shear over at
// most 73,728 steps, the corner's lower bits, the line's own rounding.
constexpr float kCornerError = 16.0f;
// A grid of 65,536 steps and a half of a quarter beyond each end: sheared it ends within 31 bits.
constexpr float kFirstStep = -8192.0f, kLastStep = 73728.0f;

}  // namespace

BaseHullSegment::BaseHullSegment(const BaseHull& base_hull, math::Vec3 a_m, math::Vec3 b_m)
    : coordinates_(base_hull.upper_coordinates()),
      made_count_(base_hull.head().made_count),
      bytes_(3 * base_hull.coordinate_bytes()) {
  const BaseHullHead& head = base_hull.head();
  const math::Vec3 along_m = b_m - a_m;
  const float a[3] = {a_m.x, a_m.y, a_m.z}, step[3] = {along_m.x, along_m.y, along_m.z};
  for (uint32_t k = 0; k < 3; ++k) {
    grid_low_m_[k] = base_hull.grid_low_m()[k];
    axis_[k] = {0, 0, kEnd, k, 3 + k};
    at_[k] = k * base_hull.coordinate_bytes();
  }
  steps_per_m_ =
      1.0f / (base_hull.coordinate_bytes() == 2 ? base_hull.cell_m() : base_hull.cell_m() * 256.0f);
  float first = 0.0f, last = 1.0f;
  for (uint32_t k = 0; k < 3; ++k) {
    const float size = absolute(step[k]);
    if (!(size <= kFar_m && absolute(a[k]) <= kFar_m)) return;  // every box is entered at once
    const float rate = 1.0f / (size > kStill_m ? step[k] : kStill_m);
    const float one = (head.low_m[k] - a[k] - kPad_m) * rate;
    const float other = (head.high_m[k] - a[k] + kPad_m) * rate;
    const float in = one < other ? one : other, out = one < other ? other : one;
    first = in > first ? in : first;
    last = out < last ? out : last;
  }
  last = last * (1.0f + 0x1p-20f) + 0x1p-100f;
  misses_ = !(first <= last);
  if (misses_) return;
  first = first * (1.0f - 0x1p-20f);
  last = last < 1.0f ? last : 1.0f;
  begin_ = first;
  times_ = static_cast<float>(kEnd) / within(last - first, 0x1p-40f, 1.0f) * (1.0f + 0x1p-20f);
  float from_m[3], to_m[3], error_m[3];
  for (uint32_t k = 0; k < 3; ++k) {
    from_m[k] = a[k] + first * step[k];
    to_m[k] = a[k] + last * step[k];
    error_m[k] = 0x1p-21f * (absolute(a[k]) + absolute(step[k]) + absolute(head.low_m[k]) +
                             absolute(head.high_m[k])) +
                 kPad_m;
  }
  open_axes(head, from_m, to_m, error_m);
  open_line(from_m, step, error_m);
}

// An axis along which the part moves less than half a 256th is taken to move so much; its planes
// are padded by as much.
void BaseHullSegment::open_axes(const BaseHullHead& head, const float (&from_m)[3],
                                const float (&to_m)[3], const float (&error_m)[3]) {
  for (uint32_t k = 0; k < 3; ++k) {
    const float side_m = head.high_m[k] - head.low_m[k];
    if (!(side_m > kStill_m)) continue;  // no plane of it gives anything
    const float per_m = 256.0f / side_m;
    const float from = within((from_m[k] - head.low_m[k]) * per_m, -1.0f, 257.0f);
    const float to = within((to_m[k] - head.low_m[k]) * per_m, -1.0f, 257.0f);
    const bool falls = to < from;
    const float moved = absolute(to - from);
    const bool stands = !(moved > 0.5f);
    const float wide = error_m[k] * per_m + kPositionError + (stands ? 0.5f : 0.0f);
    const float pad = wide < 256.0f ? wide : 256.0f;
    const float rate = static_cast<float>(kEnd) / (stands ? 0.5f : moved);
    const float position = falls ? 256.0f - from : from;
    axis_[k].rate = static_cast<int32_t>(rate);
    axis_[k].near = static_cast<int32_t>(-(position + pad) * rate - kTimeSlack);
    axis_[k].far = static_cast<int32_t>((256.0f + pad - position) * rate + kTimeSlack);
    axis_[k].first = falls ? 3 + k : k;
    axis_[k].last = falls ? k : 3 + k;
  }
}

void BaseHullSegment::open_line(const float (&from_m)[3], const float (&step_m)[3],
                                const float (&error_m)[3]) {
  const float x = absolute(step_m[0]), y = absolute(step_m[1]), z = absolute(step_m[2]);
  longest_ = x > y && x > z ? 0 : y > z ? 1 : 2;
  const uint32_t k = longest_, i = k == 2 ? 0 : k + 1, j = i == 2 ? 0 : i + 1;
  float position[3], error = 0.0f;
  for (uint32_t n = 0; n < 3; ++n) {
    position[n] = (from_m[n] - grid_low_m_[n]) * steps_per_m_;
    if (!(position[n] >= kFirstStep && position[n] <= kLastStep)) return;
    if (!(error_m[n] * steps_per_m_ <= error)) error = error_m[n] * steps_per_m_;
  }
  const float margin = kCornerError + 2.0f * error;
  const float inverse = 1.0f / step_m[k];
  if (!(margin <= 8192.0f) || !(absolute(step_m[k]) > kStill_m)) return;
  const uint32_t bytes = at_[1];
  at_[0] = i * bytes;
  at_[1] = j * bytes;
  at_[2] = k * bytes;
  const float scale = static_cast<float>(1 << kShearBits);
  const float shear[2] = {step_m[i] * inverse * scale, step_m[j] * inverse * scale};
  const float beside[2] = {position[i], position[j]};
  for (uint32_t n = 0; n < 2; ++n) {
    line_.shear[n] = static_cast<uint32_t>(static_cast<int32_t>(shear[n]));
    line_.from[n] = (static_cast<uint32_t>(static_cast<int32_t>(beside[n])) << kShearBits) -
                    static_cast<uint32_t>(static_cast<int32_t>(position[k])) * line_.shear[n];
  }
  const uint32_t eights = (static_cast<uint32_t>(margin) >> (16 - kShearBits)) + 3;
  line_.margin = eights << 16 | eights;
}

uint32_t BaseHullSegment::beside_of_kept(const BaseHullVertex& kept) const {
  const float at_m[3] = {kept.x_m, kept.y_m, kept.z_m};
  uint32_t step[3];
  for (uint32_t n = 0; n < 3; ++n) {
    const float position = (at_m[n] - grid_low_m_[n]) * steps_per_m_;
    if (!(position >= kFirstStep && position <= kLastStep)) return 0;  // on the line: on no side
    step[n] = static_cast<uint32_t>(static_cast<int32_t>(position));
  }
  const uint32_t k = longest_, i = k == 2 ? 0 : k + 1, j = i == 2 ? 0 : i + 1;
  return line_.beside(step[i], step[j], step[k]);
}

}  // namespace firmtouch::hull
