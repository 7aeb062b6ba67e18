#pragma once
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/record/tick.hpp"

// What the hands of all examples use. A program of yours needs none of it.
namespace firmtouch {

inline bool is_between(float value, float low, float high) { return value >= low && value <= high; }
inline bool is_near(float a, float b, float most = 1e-4f) { return is_between(a - b, -most, most); }

/// Input of a tick of 1 ms, spelled out in touch_mesh.cpp: the encoders count where the hand is,
/// and the enable switch is closed from the second tick on.
inline record::TickInput input_at(uint32_t tick, math::Vec3 hand_m) {
  constexpr float kCountsPerMetre = 100000.0f;  // initial value of counts_per_metre_x, _y, _z
  record::TickInput input{};
  input.tick = tick;
  input.clock_us = tick * 1000;
  input.encoder_counts[0] = static_cast<int32_t>(hand_m.x * kCountsPerMetre);
  input.encoder_counts[1] = static_cast<int32_t>(hand_m.y * kCountsPerMetre);
  input.encoder_counts[2] = static_cast<int32_t>(hand_m.z * kCountsPerMetre);
  if (tick > 0) input.flags = record::kFlagEnable;
  return input;
}

/// Adds a tick to the example's picture (pictures/draw.cpp). On a board it does nothing.
void show(math::Vec3 tool_m, math::Vec3 force_N, float period_s = 0.001f);

inline void show(const record::TickOutput& output, float period_s = 0.001f) {
  const float(&at_m)[3] = output.position_m, (&force_N)[3] = output.force_N;
  show({at_m[0], at_m[1], at_m[2]}, {force_N[0], force_N[1], force_N[2]}, period_s);
}

}  // namespace firmtouch
