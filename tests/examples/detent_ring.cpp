// What you feel: a ring of 12 notches. Led round it, the tool is drawn into each notch, and out of
// it against a rising force, until it clicks into the next.
// Picture: pictures/detent_ring.svg
//
// An effect of your own is a free function that adds to the local model: here a line through the
// nearest notch, across which a spring pulls. Along the line, in and out, the tool is free.
#include "firmtouch/math/elementary.hpp"
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/servo/step.hpp"
#include "hand.hpp"

using namespace firmtouch;

namespace {

constexpr uint32_t kNotches = 12;
constexpr float kTurn_rad = 6.2831853f;
constexpr float kPitch_rad = kTurn_rad / kNotches;
constexpr float kStiffness_N_per_m = 300.0f;
constexpr servo::Settings kSettings{/*force_limit_N*/ 8.0f, /*slew_limit_N_per_s*/ 5000.0f,
                                    /*ramp_in_s*/ 0.02f, /*tick_period_s*/ 0.001f};

// The effect.
void add_detents(math::Vec3 position_m, servo::LocalModel& model) {
  const float angle_rad = math::arc_tangent2(position_m.y, position_m.x) + kTurn_rad;
  const uint32_t notch = static_cast<uint32_t>(angle_rad / kPitch_rad + 0.5f);
  const float notch_rad = kPitch_rad * static_cast<float>(notch);
  servo::GuideLine line;  // from the centre of the ring outwards
  line.direction = {math::cosine(notch_rad), math::sine(notch_rad), 0};
  line.stiffness_N_per_m = kStiffness_N_per_m;
  scene::add_guide(model, line);
}

servo::State state;

math::Vec3 tick(uint32_t number, math::Vec3 position_m) {
  servo::LocalModel model;
  scene::begin_model(model, position_m, number, /*age_ticks*/ 2);
  add_detents(position_m, model);
  servo::StepInput input;
  input.position_m = position_m;
  input.tick = number;
  input.enable = true;
  const math::Vec3 force_N = servo::step(state, kSettings, model, input).force_N;
  show(position_m, force_N);
  return force_N;
}

}  // namespace

// The hand leads the tool round twice at 30 mm from the centre, a turn in four seconds.
int main() {
  constexpr uint32_t kTicksOfATurn = 4000;
  uint32_t clicks = 0;
  float strongest_N = 0, last_N = 0;
  bool is_right = true;
  for (uint32_t i = 0; i < 2 * kTicksOfATurn; ++i) {
    const float angle_rad = kTurn_rad * static_cast<float>(i) / kTicksOfATurn;
    const float cosine = math::cosine(angle_rad), sine = math::sine(angle_rad);
    const math::Vec3 force_N = tick(i, {0.03f * cosine, 0.03f * sine, 0});
    const float onward_N = force_N.y * cosine - force_N.x * sine;  // along the way round
    if (last_N < -1.0f && onward_N > -1.0f) ++clicks;              // held back, then drawn on
    if (onward_N > strongest_N) strongest_N = onward_N;
    last_N = onward_N;
  }
  // Half a pitch away from a notch: 300 N/m * 30 mm * sin 15 degrees, across the line.
  const float expected_N = kStiffness_N_per_m * 0.03f * math::sine(kPitch_rad / 2);
  is_right &= clicks == 2 * kNotches;
  is_right &= strongest_N > 0.95f * 0.966f * expected_N && strongest_N < 1.01f * expected_N;
  return is_right ? 0 : 1;
}
