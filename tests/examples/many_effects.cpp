// What you feel: a rail of notches, 4 mm apart, on a firm table, in thin oil. Moved faster than
// 50 mm/s the oil thickens. Press hard, and the notches fade: the table keeps its force.
// Picture: pictures/many_effects.svg
//
// A sum holds contact and all effects within the limit of force, in the order of the calls. What
// does not fit gets a smaller share. A store keeps the notches passive while their share changes.
#include "firmtouch/scene/compose.hpp"
#include "firmtouch/scene/effect_sum.hpp"
#include "firmtouch/servo/force_parts.hpp"
#include "firmtouch/servo/step.hpp"
#include "hand.hpp"

using namespace firmtouch;

namespace {

constexpr servo::Settings kSettings{/*force_limit_N*/ 5.0f, /*slew_limit_N_per_s*/ 5000.0f,
                                    /*ramp_in_s*/ 0.0f, /*tick_period_s*/ 0.001f};
constexpr scene::Material kTable{/*stiffness_N_per_m*/ 1000.0f, /*damping_N_s_per_m*/ 0.0f};
constexpr scene::Detents kNotches{/*notch_m*/ {}, /*direction*/ {1, 0, 0}, /*pitch_m*/ 0.004f,
                                  /*limit_N*/ 2.0f};
constexpr scene::SpeedWall kOil{/*free_mps*/ 0.05f, {/*damping_N_s_per_m*/ 20.0f, /*limit_N*/ 2}};

scene::EffectStore notches;
servo::State state;
uint32_t now = 0;

math::Vec3 tick(math::Vec3 position_m, math::Vec3 velocity_mps) {
  servo::LocalModel model;
  scene::begin_model(model, position_m, now, /*age_ticks*/ 2);
  scene::add_contact(model, position_m, /*radius_m*/ 0, {position_m.z, {0, 0, 1}, /*sign*/ 1},
                     kTable);
  scene::EffectSum sum(kSettings.force_limit_N, servo::contact_N(model, position_m, velocity_mps));
  sum.add(scene::detents_at(kNotches, position_m), notches);
  sum.add(scene::speed_wall_N(kOil, velocity_mps));
  sum.put(position_m, model);
  const servo::StepInput input{position_m, velocity_mps, now++, /*enable*/ true};
  const math::Vec3 force_N = servo::step(state, kSettings, model, input).force_N;
  show(position_m, force_N);
  return force_N;
}

// Along 40 mm of the rail at a depth. The range of the force along it, without the oil's.
struct Range {
  float least_N = 9, most_N = -9, table_N = 0;
};
Range slide(float speed_mps, float depth_m) {
  Range range;
  const uint32_t ticks = static_cast<uint32_t>(40.0f / speed_mps);
  for (uint32_t i = 0; i < ticks; ++i) {
    const float x_m = 0.001f * speed_mps * static_cast<float>(i);
    const math::Vec3 force_N = tick({x_m, 0, -depth_m}, {speed_mps, 0, 0});
    if (i < 10) continue;  // the force rises by its slew limit
    if (force_N.x < range.least_N) range.least_N = force_N.x;
    if (force_N.x > range.most_N) range.most_N = force_N.x;
    range.table_N = force_N.z;
  }
  return range;
}

}  // namespace

int main() {
  bool is_right = true;
  // Slowly, with 1 N on the table: the whole notches.
  const Range slow = slide(0.04f, 0.001f);
  is_right &= is_near(slow.most_N, 2, 0.01f) && is_near(slow.least_N, -2, 0.01f);
  is_right &= is_near(slow.table_N, 1, 0.01f);
  // Three times as fast: the oil adds 20 N s/m x 70 mm/s = 1.4 N.
  const Range fast = slide(0.12f, 0.001f);
  is_right &= is_near(fast.most_N, 2 - 1.4f, 0.05f) && is_near(fast.least_N, -2 - 1.4f, 0.05f);
  // Slowly, with 4.9 N on the table: sqrt(5^2 - 4.9^2) = 0.995 N are left.
  const Range hard = slide(0.04f, 0.0049f);
  is_right &= is_near(hard.most_N, 0.995f, 0.01f) && is_near(hard.least_N, -0.995f, 0.01f);
  is_right &= is_near(hard.table_N, 4.9f, 0.01f);
  // With more than the motors can: the table has it all.
  const Range most = slide(0.04f, 0.006f);
  is_right &= is_near(most.most_N, 0, 0.01f) && is_near(most.least_N, 0, 0.01f);
  is_right &= is_near(most.table_N, 5, 0.01f);
  return is_right && state.faults == 0 ? 0 : 1;
}
