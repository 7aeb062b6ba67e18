// Every float special in every field of what servo takes, and random bits in what it keeps: the
// force that reaches the motors stays finite, within its limit and within its slew, whatever
// happens.
#include <stddef.h>
#include <stdint.h>

#include "firmtouch/servo/evaluate.hpp"
#include "firmtouch/servo/fault.hpp"
#include "firmtouch/servo/guard.hpp"
#include "firmtouch/servo/step.hpp"
#include "harness/test.hpp"
#include "servo/specials.hpp"

namespace math = firmtouch::math;
namespace servo = firmtouch::servo;
namespace test = firmtouch::test;

namespace {

struct Everything {
  servo::Settings settings{8.0f, 2000.0f, 0.01f, 0.001f};
  servo::LocalModel model;
  servo::StepInput input;
};

Everything usual() {
  Everything all;
  all.model.plane_count = 3;
  for (uint32_t i = 0; i < 3; ++i) {
    all.model.plane[i].normal = {i == 0 ? 1.0f : 0.0f, i == 1 ? 1.0f : 0.0f, i == 2 ? 1.0f : 0.0f};
    all.model.plane[i].offset_m = 0.002f;
    all.model.plane[i].stiffness_N_per_m = 900.0f;
    all.model.plane[i].damping_N_s_per_m = 3.0f;
  }
  all.model.guide.direction = {1, 0, 0};
  all.model.guide.stiffness_N_per_m = 300.0f;
  all.model.guide.damping_N_s_per_m = 1.0f;
  all.model.guide.tunnel_m = 0.0001f;
  all.model.guide.drive_N = 0.5f;
  all.model.guide.drive_stiffness_N_per_m = 300.0f;
  all.model.guide.drive_damping_N_s_per_m = 1.0f;
  all.model.guide.drive_limit_N = 1.0f;
  all.model.has_guide = true;
  all.model.expires_tick = 1u << 30;
  all.input.enable = true;
  return all;
}

// Calls visit(offset in Everything) for each float of it.
template <class Visit>
void for_each_float(Visit visit) {
  for (size_t at = 0; at < sizeof(servo::Settings); at += 4)
    visit(offsetof(Everything, settings) + at);
  const size_t model = offsetof(Everything, model);
  for (size_t at = 0; at < offsetof(servo::LocalModel, plane_count); at += 4) visit(model + at);
  for (size_t at = offsetof(servo::LocalModel, guide); at < offsetof(servo::LocalModel, has_guide);
       at += 4) {
    visit(model + at);
  }
  for (size_t at = 0; at < sizeof(math::Vec3); at += 4)
    visit(model + offsetof(servo::LocalModel, made_at_m) + at);
  const size_t input = offsetof(Everything, input);
  for (size_t at = 0; at < offsetof(servo::StepInput, tick); at += 4) visit(input + at);
}

void put(Everything& all, size_t offset, uint32_t bits) {
  __builtin_memcpy(reinterpret_cast<unsigned char*>(&all) + offset, &bits, 4);
}

// Whether `now` keeps its promise after `before`: finite, within the limit, and grown by no more
// than the slew.
bool keeps_promise(math::Vec3 before, math::Vec3 now, const servo::Settings& settings) {
  if (!test::is_number(now)) return false;
  if (!(test::square(now) <= test::square(settings.force_limit_N))) return !(test::square(now) > 0);
  if (test::square(now) <= test::square(before)) return true;
  const double step = static_cast<double>(settings.slew_limit_N_per_s) *
                      static_cast<double>(settings.tick_period_s);
  return test::square_of_change(before, now) <= step * step;
}

}  // namespace

TEST(EverySpecialInEveryFieldKeepsTheForceFiniteLimitedAndSlow) {
  uint32_t fields = 0, broken = 0, faulted = 0;
  for_each_float([&](size_t offset) {
    ++fields;
    for (const uint32_t bits : test::kSpecialBits) {
      servo::State state;
      math::Vec3 before;
      for (uint32_t tick = 0; tick < 40; ++tick) {
        Everything all = usual();
        all.input.tick = tick;
        const float swing = tick % 2 == 0 ? -0.001f : 0.0015f;
        all.input.position_m = {swing, -0.5f * swing, 0.001f};
        all.input.velocity_mps = {-swing * 30, 0, swing * 10};
        if (tick >= 20 && tick < 23) put(all, offset, bits);
        const servo::StepOutput output = servo::step(state, all.settings, all.model, all.input);
        // With a fault, the usual settings are the promise to check, not the corrupted ones.
        const servo::Settings& promised = output.faults != 0 ? usual().settings : all.settings;
        if (!keeps_promise(before, output.force_N, promised)) ++broken;
        before = output.force_N;
      }
      if (state.faults != 0) ++faulted;
    }
  });
  CHECK_EQ(broken, 0u);
  CHECK_EQ(fields, 49u);
  CHECK_GE(faulted, 50u * 4u);
}

TEST(NaN_IsAFaultInItsTick_InEveryField) {
  for_each_float([](size_t offset) {
    servo::State state;
    Everything all = usual();
    (void)servo::step(state, all.settings, all.model, all.input);
    put(all, offset, 0x7FC00000u);
    const servo::StepOutput output = servo::step(state, all.settings, all.model, all.input);
    firmtouch::test::note("field at byte", static_cast<int64_t>(offset));
    CHECK_NE(output.faults, 0u);
    CHECK_EQ(output.force_N.x, 0.0f);
  });
}

TEST(SameInputsGiveTheSameBits) {
  servo::State a, b;
  test::Random random;
  for (uint32_t tick = 0; tick < 2000; ++tick) {
    Everything all = usual();
    all.input.tick = tick;
    all.input.position_m = {0.004f * random.unit(), 0.004f * random.unit(), 0.004f * random.unit()};
    all.input.velocity_mps = {random.unit(), random.unit(), random.unit()};
    const servo::StepOutput x = servo::step(a, all.settings, all.model, all.input);
    const servo::StepOutput y = servo::step(b, all.settings, all.model, all.input);
    CHECK_EQ(math::bits_of(x.force_N.x), math::bits_of(y.force_N.x));
    CHECK_EQ(math::bits_of(x.force_N.y), math::bits_of(y.force_N.y));
    CHECK_EQ(math::bits_of(x.force_N.z), math::bits_of(y.force_N.z));
    CHECK(x.mode == y.mode);
    CHECK_EQ(x.faults, y.faults);
  }
}

TEST(FlippedBitsInTheServosMemoryDoNotPassTheGuard) {
  test::Random random;
  uint32_t broken = 0, tripped = 0;
  const servo::GuardLimits limits{8.0f, 2000.0f, 0.001f};
  for (uint32_t round = 0; round < 3000; ++round) {
    servo::State state;
    servo::GuardState guard;
    CHECK(servo::guard_set_limits(guard, limits));
    math::Vec3 before;
    const uint32_t hit_at = 10 + random.next() % 20;
    for (uint32_t tick = 0; tick < 40; ++tick) {
      Everything all = usual();
      all.input.tick = tick;
      all.input.position_m = {0.003f * random.unit(), 0.003f * random.unit(),
                              0.003f * random.unit()};
      if (tick == hit_at) {
        const uint32_t bit =
            random.next() % (8 * static_cast<uint32_t>(sizeof state + sizeof guard));
        unsigned char* byte =
            bit / 8 < sizeof state
                ? reinterpret_cast<unsigned char*>(&state) + bit / 8
                : reinterpret_cast<unsigned char*>(&guard) + bit / 8 - sizeof state;
        *byte = static_cast<unsigned char>(*byte ^ (1u << (bit % 8)));
      }
      const servo::StepOutput output = servo::step(state, all.settings, all.model, all.input);
      float motor_N[3] = {output.force_N.x, output.force_N.y, output.force_N.z};
      if (!servo::guard(guard, output.faults == 0, false, motor_N)) ++tripped;
      const math::Vec3 now{motor_N[0], motor_N[1], motor_N[2]};
      if (!test::is_number(now) || test::square(now) > 8.0001 * 8.0001) ++broken;
      // The guard looks at each axis; 2 N a tick and its own rounding.
      const float from[3] = {before.x, before.y, before.z};
      for (int k = 0; k < 3; ++k) {
        const float size = motor_N[k] < 0 ? -motor_N[k] : motor_N[k];
        const bool same_side = (motor_N[k] < 0) == (from[k] < 0);
        const float was = !same_side ? 0.0f : from[k] < 0 ? -from[k] : from[k];
        if (size > was + 2.003f) ++broken;
      }
      before = now;
    }
  }
  CHECK_EQ(broken, 0u);
  CHECK_GE(tripped, 100u);
}
