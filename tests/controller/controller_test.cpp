// The controller without an asset, as it is between power-on and the end of begin(): it measures,
// and pushes nothing.
#include "firmtouch/controller/full_controller.hpp"

#include <stdint.h>

#include "firmtouch/servo/fault.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
namespace {

FullController g_controller;

record::TickInput at(uint32_t tick, int32_t counts) {
  record::TickInput input{};
  input.tick = tick;
  input.clock_us = tick * 1000u;
  for (int32_t& count : input.encoder_counts) count = counts;
  return input;
}

uint32_t servo_mode(const record::TickOutput& output) {
  return output.state & record::kStateServoMask;
}

bool is_still(const record::TickOutput& output) {
  for (uint32_t k = 0; k < record::kAxes; ++k) {
    if (output.motor_N[k] < 0 || output.motor_N[k] > 0) return false;
  }
  return true;
}

}  // namespace

// The RAM of a controller: a release that grows it says so here. (Pointers are twice as wide on a
// 64-bit host.)
static_assert(sizeof(FullController) <= (sizeof(void*) == 8 ? 5936 : 5000),
              "the controller outgrew its RAM budget");

TEST(NoAsset_PositionIsMeasured_MotorsAreOff) {
  g_controller.reset();
  record::TickOutput output;
  for (uint32_t tick = 0; tick < 50; ++tick) {
    record::TickInput input = at(tick, static_cast<int32_t>(20 * tick));
    input.flags = record::kFlagEnable;
    g_controller.tick(input, output);
    CHECK(is_still(output));
    CHECK_EQ(output.faults, 0u);
    CHECK_EQ(servo_mode(output), static_cast<uint32_t>(servo::Mode::kOff));
  }
  CHECK_LE(output.position_m[0], 0.00981f);
  CHECK_GE(output.velocity_mps[1], 0.199f);
  CHECK(!g_controller.is_ready());
}

TEST(BrokenAssetIsRefusedByItsRuleAndLatchesAFaultWhenEnabled) {
  alignas(16) static const uint8_t nonsense[64] = {'F', 'T', 'A', 0x1A, 1};
  CHECK(!g_controller.open(nonsense).ok());
  CHECK_NE(g_controller.verdict().rule, 0u);
  CHECK_EQ(g_controller.asset_crc(), 0u);
  record::TickOutput output;
  record::TickInput input = at(0, 0);
  g_controller.tick(input, output);
  CHECK_EQ(output.faults, 0u);  // no fault before it is enabled
  input = at(1, 0);
  input.flags = record::kFlagEnable;
  g_controller.tick(input, output);
  CHECK_EQ(output.faults, servo::kFaultAsset);
  CHECK(is_still(output));
  CHECK(!g_controller.open(firmtouch::core::Bytes{}).ok());
}

TEST(ParameterCommand_ActsInItsTick_OnlyWithinItsRange) {
  g_controller.reset();
  record::TickOutput output;
  record::TickInput input = at(0, 100);
  input.command = 1 + params::kCountsPerMetreX;
  input.command_value = 1000.0f;
  g_controller.tick(input, output);
  CHECK_NE(output.state & record::kStateCommandTaken, 0u);
  CHECK_EQ(output.position_m[0], 0.1f);
  const uint32_t bad[] = {params::kCount + 1u, params::kCount + 77u, UINT32_MAX - 1u};
  for (const uint32_t command : bad) {
    input = at(1, 100);
    input.command = command;
    g_controller.tick(input, output);
    CHECK_NE(output.state & record::kStateCommandRefused, 0u);
  }
  for (uint32_t row = 0; row < params::kCount; ++row) {
    input = at(2, 100);
    input.command = 1 + row;
    input.command_value = __builtin_nanf("");
    const float before = g_controller.values().value[row];
    g_controller.tick(input, output);
    CHECK_NE(output.state & record::kStateCommandRefused, 0u);
    CHECK_EQ(g_controller.values().value[row], before);
  }
  g_controller.reset();
  CHECK_EQ(g_controller.values()[params::kCountsPerMetreX], 100000.0f);
}

TEST(WhileEnabled_PositionAndTimeParameters_AreFixed) {
  g_controller.reset();
  record::TickOutput output;
  for (uint32_t row = 0; row < params::kCount; ++row) {
    record::TickInput input = at(row, 0);
    input.flags = record::kFlagEnable;
    input.command = 1 + row;
    input.command_value = params::kTable[row].low;
    g_controller.tick(input, output);
    const bool taken = (output.state & record::kStateCommandTaken) != 0;
    CHECK_EQ(taken, params::kTable[row].when != params::When::kMotorsOff);
  }
  g_controller.reset();
}

TEST(WhileEnabled_ScenePositionIsFixed_LimitsOnlyFall) {
  g_controller.reset();
  record::TickOutput output;
  uint32_t tick = 0;
  const auto takes = [&](uint32_t row, float value, uint32_t lines) {
    record::TickInput input = at(tick++, 0);
    input.flags = lines;
    input.command = 1 + row;
    input.command_value = value;
    g_controller.tick(input, output);
    return (output.state & record::kStateCommandTaken) != 0;
  };
  const uint32_t scene[] = {params::kSceneX, params::kSceneY, params::kSceneZ};
  for (const uint32_t row : scene) {
    CHECK(!takes(row, 0.01f, record::kFlagEnable));
    CHECK(takes(row, 0.01f, 0));
  }
  const uint32_t limits[] = {params::kForceLimit, params::kSlewLimit, params::kMeshWork,
                             params::kGuideWork};
  for (const uint32_t row : limits) {
    const float now = params::kTable[row].initial;
    CHECK(!takes(row, 1.001f * now, record::kFlagEnable));
    CHECK_EQ(g_controller.values().value[row], now);
    CHECK(takes(row, now, record::kFlagEnable));
    CHECK(takes(row, 0.5f * now, record::kFlagEnable));
    CHECK(!takes(row, now, record::kFlagEnable));
    CHECK_EQ(g_controller.values().value[row], 0.5f * now);
    CHECK(takes(row, 1.5f * now, 0));
  }
  g_controller.reset();
}
