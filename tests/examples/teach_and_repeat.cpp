// What you feel: you lead the tool through a figure once. Then it leads your hand through the same
// figure, at its own pace, and gives way where you hold it back.
// Picture: pictures/teach_and_repeat.svg
//
// Places are kept in fixed memory, one a millimetre. To repeat them an effect draws the tool onto
// the piece between two of them, and drives it along. (`firmtouch bake RUN.ftl --teach NAME` makes
// a guide of a recorded run instead, thinned and certified: follow_path.cpp.)
#include "firmtouch/math/elementary.hpp"
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/servo/step.hpp"
#include "hand.hpp"

using namespace firmtouch;

namespace {

constexpr float kApart_m = 0.001f;
constexpr float kPace_mps = 0.03f;
constexpr servo::Settings kSettings{/*force_limit_N*/ 4.0f, /*slew_limit_N_per_s*/ 5000.0f,
                                    /*ramp_in_s*/ 0.1f, /*tick_period_s*/ 0.001f};

math::Vec3 taught_m[512];
uint32_t taught = 0, next = 1;  // next: the end of the piece where the tool is

math::Vec3 operator-(math::Vec3 a, math::Vec3 b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
math::Vec3 operator+(math::Vec3 a, math::Vec3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
math::Vec3 operator*(math::Vec3 a, float s) { return {a.x * s, a.y * s, a.z * s}; }
float dot(math::Vec3 a, math::Vec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
float length_m(math::Vec3 v) { return math::safe_square_root(dot(v, v)); }

void teach(math::Vec3 position_m) {
  if (taught == 512 || (taught > 0 && length_m(position_m - taught_m[taught - 1]) < kApart_m))
    return;
  taught_m[taught++] = position_m;
}

// The effect.
void repeat(math::Vec3 position_m, servo::LocalModel& model) {
  math::Vec3 way_m = taught_m[next] - taught_m[next - 1];
  while (next + 1 < taught && dot(position_m - taught_m[next], way_m) > 0) {
    ++next;
    way_m = taught_m[next] - taught_m[next - 1];
  }
  servo::GuideLine line;
  line.point_m = taught_m[next];
  line.direction = way_m * (1.0f / length_m(way_m));
  line.stiffness_N_per_m = 600.0f;
  line.damping_N_s_per_m = 3.0f;
  // A damper that moves at the pace: 0.3 N from rest, nothing at the pace; at the end a spring.
  line.drive_damping_N_s_per_m = 10.0f;
  line.drive_limit_N = 1.0f;
  if (next + 1 < taught)
    line.drive_N = line.drive_damping_N_s_per_m * kPace_mps;
  else
    line.drive_stiffness_N_per_m = 300.0f;
  scene::add_guide(model, line);
}

servo::State state;

math::Vec3 tick(uint32_t number, math::Vec3 position_m, math::Vec3 velocity_mps) {
  servo::LocalModel model;
  scene::begin_model(model, position_m, number, /*age_ticks*/ 2);
  repeat(position_m, model);
  const servo::StepInput input{position_m, velocity_mps, number, /*enable*/ true};
  const math::Vec3 force_N = servo::step(state, kSettings, model, input).force_N;
  show(position_m, force_N);
  return force_N;
}

math::Vec3 figure_m(float turns) {  // an eight, 60 mm long
  const float angle_rad = 6.2831853f * turns;
  return {0.03f * math::sine(angle_rad), 0.01f * math::sine(2 * angle_rad), 0.005f * turns};
}

// How far the tool is from the whole figure.
float off_m(math::Vec3 position_m) {
  float least_m = 1;
  for (uint32_t i = 0; i <= 2000; ++i) {
    const float m = length_m(position_m - figure_m(static_cast<float>(i) / 2000));
    if (m < least_m) least_m = m;
  }
  return least_m;
}

}  // namespace

int main() {
  for (uint32_t i = 0; i <= 4000; ++i) teach(figure_m(static_cast<float>(i) / 4000));
  bool is_right = taught > 120 && taught < 512;
  // The hand rests on the tool: 0.1 kg, and 1 N s/m of its own.
  math::Vec3 at_m = taught_m[0], moving_mps;
  uint32_t ticks = 0, last = next;
  for (; ticks < 12000 && length_m(at_m - taught_m[taught - 1]) > 0.0005f; ++ticks) {
    const bool is_held = ticks >= 2000 && ticks < 3000;  // for a second: it waits
    const math::Vec3 force_N = tick(ticks, at_m, moving_mps);
    is_right &= length_m(force_N) < 1.5f && next >= last;
    last = next;
    moving_mps = moving_mps + (force_N - moving_mps * 1.0f) * (0.001f / 0.1f);
    if (is_held) moving_mps = {};
    at_m = at_m + moving_mps * 0.001f;
    if (ticks % 50 == 0) is_right &= off_m(at_m) < 0.0002f;
  }
  // The figure is 147 mm long: at 0.3 N / (10 + 1) N s/m, and a second that it was held.
  is_right &= ticks > 5500 && ticks < 8000 && next + 1 == taught;
  return is_right && state.faults == 0 ? 0 : 1;
}
