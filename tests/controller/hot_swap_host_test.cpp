// The asset is swapped while ticks run: no step of the force above its slew limit, every bit again
// on replay, and nothing else of a tick changes while the next asset is loaded.
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "bake/asset/origin.hpp"
#include "controller/ride.hpp"
#include "harness/long.hpp"
#include "harness/random.hpp"

namespace firmtouch::controller_test {
namespace {

using Swapping = SwappingController;

constexpr float kSlew_N_per_s = 400.0f;  // 0.4 N a tick of 1 ms

// The part turned on its head and raised by 3 mm: the ride is inside of it here, and clear there.
// Its coordinates count from another origin.
const Asset& other() {
  static const Asset made([] {
    tools::Surface mesh = tools::make_part(2, 4000);
    for (math::Vec3& vertex : mesh.vertices) {
      vertex.z = 0.003f - vertex.z;
      vertex.y = -vertex.y - 4;
    }
    std::vector<tools::Section> sections = mesh_sections(mesh, "lid");
    sections.push_back(tools::origin_section({0, 4, 0}));
    return file_of(std::move(sections));
  }());
  return made;
}

void load_next(Swapping& controller, core::Bytes asset) {
  controller.begin_next(asset);
  while (!controller.work_next(kSliceUnits)) {
  }
}

record::TickInput input_of(const Ride& ride, uint32_t tick) {
  record::TickInput input = ride.input;
  if (tick == 2) {
    input.command = 1 + params::kSlewLimit;
    input.command_value = kSlew_N_per_s;
  }
  return input;
}

struct Run {
  std::vector<record::TickRecord> records;
  uint32_t swaps = 0, pressed = 0, inside = 0;
  double largest_step_N = 0;
};

// Rides, with `swaps` swaps at random ticks. Both assets are loaded once.
Run run_of(uint32_t swaps, uint32_t seed) {
  Ride ride;  // for its inputs
  Swapping controller;
  CHECK(controller.open(both().bytes()).ok());
  load_next(controller, other().bytes());
  CHECK(controller.next_verdict().ok());
  CHECK_EQ(controller.next_crc() != controller.asset_crc(), true);
  test::Xorshift random(seed);
  Run run;
  math::Vec3 before_N{};
  for (uint32_t tick = 0, next = 40; run.swaps < swaps; ++tick) {
    ride.fill(tick);
    record::TickRecord now{input_of(ride, tick), {}};
    if (tick == next) {
      now.input.command = record::kCommandSwapAsset;
      next += 1 + random() % 60;
    }
    controller.tick(now.input, now.output);
    const math::Vec3 force_N{now.output.force_N[0], now.output.force_N[1], now.output.force_N[2]};
    const double step_N = std::hypot(static_cast<double>(force_N.x - before_N.x),
                                     static_cast<double>(force_N.y - before_N.y),
                                     static_cast<double>(force_N.z - before_N.z));
    run.largest_step_N = std::fmax(run.largest_step_N, step_N);
    if (now.input.command == record::kCommandSwapAsset) {
      CHECK((now.output.state & record::kStateCommandTaken) != 0);
      ++run.swaps;
      run.pressed += size_of(now.output.force_N) > 1;
      run.inside += now.output.distance_m < 0;
    }
    CHECK_EQ(now.output.faults, 0u);
    before_N = force_N;
    run.records.push_back(now);
  }
  return run;
}

TEST(HotSwap_AtRandomTicks_ForceMakesNoStep) {
  const uint32_t rounds = test::is_long() ? 40 : 2;
  uint32_t swaps = 0, pressed = 0, inside = 0;
  for (uint32_t seed = 1; seed <= rounds; ++seed) {
    const Run run = run_of(250, seed);
    swaps += run.swaps, pressed += run.pressed, inside += run.inside;
    CHECK_LE(run.largest_step_N, static_cast<double>(kSlew_N_per_s) * 0.001 * (1 + 1e-6));
  }
  CHECK_EQ(swaps, rounds * 250);
  CHECK_GE(pressed, swaps / 10);  // under load
  CHECK_GE(inside, swaps / 20);   // of the next asset
}

TEST(HotSwap_Replay_GivesEveryBit) {
  const Run run = run_of(60, 77);
  Swapping again;
  CHECK(again.open(both().bytes()).ok());
  load_next(again, other().bytes());
  uint32_t differing = 0;
  for (const record::TickRecord& recorded : run.records) {
    record::TickOutput output;
    again.tick(recorded.input, output);
    differing += std::memcmp(&output, &recorded.output, sizeof output) != 0;
  }
  CHECK_EQ(differing, 0u);
}

// Between two copies of one asset only contact begins anew: device and servo go on.
TEST(HotSwap_ToACopy_PositionAndVelocityAreThoseWithoutASwap) {
  const Asset copy(std::vector<uint8_t>(both().begin, both().begin + both().size));
  Ride ride;
  Swapping controller;
  CHECK(controller.open(both().bytes()).ok());
  load_next(controller, copy.bytes());
  uint32_t differing = 0, moving = 0, free = 0;
  for (uint32_t tick = 0; tick < 3000; ++tick) {
    ride.fill(tick);
    ride.step();
    record::TickInput input = ride.input;
    if (tick % 50 == 49) input.command = record::kCommandSwapAsset;
    record::TickOutput output;
    controller.tick(input, output);
    constexpr size_t kBytes = sizeof output.position_m;
    differing += std::memcmp(output.position_m, ride.output.position_m, kBytes) != 0;
    differing += std::memcmp(output.velocity_mps, ride.output.velocity_mps, kBytes) != 0;
    moving += size_of(output.velocity_mps) > 0.001;
    if (ride.output.distance_m < 0.0035f) continue;  // within a tool's radius of the surface
    ++free;
    differing += std::memcmp(output.force_N, ride.output.force_N, kBytes) != 0;
  }
  CHECK_EQ(differing, 0u);
  CHECK_GE(moving, 1500u);
  CHECK_GE(free, 500u);
}

// A controller that loads, meets a damaged asset and is commanded to swap differs from one that
// does none of it in nothing but the refusal.
TEST(HotSwap_NextAssetNotProven_IsRefusedAndTicksGoOn) {
  Asset damaged(std::vector<uint8_t>(other().begin, other().begin + other().size));
  damaged.begin[damaged.size / 2] ^= 1;
  Ride ride;
  Swapping controller;
  CHECK(controller.open(both().bytes()).ok());
  uint32_t differing = 0, refused = 0;
  controller.begin_next(damaged.bytes());
  for (uint32_t tick = 0; tick < 1500; ++tick) {
    ride.fill(tick);
    ride.step();
    if (tick < 500) controller.work_next(kSliceUnits);
    record::TickInput input = ride.input;
    if (tick % 100 == 50) input.command = record::kCommandSwapAsset;
    record::TickOutput output;
    controller.tick(input, output);
    refused += (output.state & record::kStateCommandRefused) != 0;
    output.state &= ~record::kStateCommandRefused;
    differing += std::memcmp(&output, &ride.output, sizeof output) != 0;
  }
  CHECK_EQ(controller.next_verdict().rule, asset::kRuleSectionCrc);
  CHECK_EQ(refused, 15u);
  CHECK_EQ(differing, 0u);
}

TEST(HotSwap_AtTwoRates_IsRefused) {
  Ride ride;
  Swapping controller;
  CHECK(controller.open(both().bytes()).ok());
  load_next(controller, other().bytes());
  CHECK(controller.can_swap());
  ride.fill(0);
  ride.input.flags |= controller.model_flags();
  ride.input.command = record::kCommandSwapAsset;
  record::TickOutput output;
  controller.tick(ride.input, output);
  CHECK((output.state & record::kStateCommandRefused) != 0);
}

TEST(HotSwap_OneScene_RefusesTheCommand) {
  Ride ride;
  ride.fill(0);
  ride.input.command = record::kCommandSwapAsset;
  ride.step();
  CHECK((ride.output.state & record::kStateCommandRefused) != 0);
}

}  // namespace
}  // namespace firmtouch::controller_test
