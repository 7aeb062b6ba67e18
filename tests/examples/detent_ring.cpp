// What you feel: a ring of 12 notches. Led round it, the tool is drawn into each notch, and out of
// it against a rising force, until it clicks into the next.
// Picture: pictures/detent_ring.svg
//
// The notches are an effect of the library. A sum holds the effects of a tick within the limit of
// force, and passive: here one alone, and no contact.
#include "firmtouch/math/elementary.hpp"
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/scene/effect_sum.hpp"
#include "firmtouch/servo/step.hpp"
#include "hand.hpp"

using namespace firmtouch;

namespace {

constexpr float kTurn_rad = 6.2831853f;
constexpr servo::Settings kSettings{/*force_limit_N*/ 8.0f, /*slew_limit_N_per_s*/ 5000.0f,
                                    /*ramp_in_s*/ 0.02f, /*tick_period_s*/ 0.001f};
constexpr scene::DetentRing kRing{
    /*centre_m*/ {}, /*axis*/ {0, 0, 1}, /*notch*/ {1, 0, 0},
    /*count*/ 12,    /*core_m*/ 0.001f,  /*limit_N*/ 2.3f};

scene::EffectStore detents;
servo::State state;

math::Vec3 tick(uint32_t number, math::Vec3 position_m) {
  servo::LocalModel model;
  scene::begin_model(model, position_m, number, /*age_ticks*/ 2);
  scene::EffectSum sum(kSettings.force_limit_N, /*contact_N*/ {});
  sum.add(scene::detents_at(kRing, position_m), detents);
  sum.put(position_m, model);
  const servo::StepInput input{position_m, /*velocity_mps*/ {}, number, /*enable*/ true};
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
  // A quarter of a pitch beyond the ridge it draws with all its force, which the core takes from.
  const float expected_N = kRing.limit_N * (1 - 0.5f * kRing.core_m / 0.03f);
  is_right &= clicks == 2 * kRing.count;
  is_right &= is_near(strongest_N, expected_N, 1e-3f);
  return is_right ? 0 : 1;
}
