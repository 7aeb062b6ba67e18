// A part that is some of its sizes away from the middle of the device, by the scene's place: as on
// a linkage, whose tip is far from its base.
#include <algorithm>
#include <cmath>

#include "controller/ride.hpp"
#include "scene/proxy_rig.hpp"

namespace firmtouch::controller_test {
namespace {

void command(uint32_t parameter, double value, record::TickInput& input) {
  input.command = 1 + parameter;
  input.command_value = static_cast<float>(value);
}

// The tool goes down to 2 mm below the face, and slides at 0.1 m/s.
void fill(uint32_t tick, double aside_m, Ride& ride) {
  const double x_m = tick < 100 ? 0.0033 : 0.0033 + 0.0001 * (tick - 100);
  const double z_m = std::max(0.008 - 0.0001 * tick, -0.002);
  ride.fill(tick);
  ride.input.encoder_counts[0] = static_cast<int32_t>(std::lround(x_m * 100000));
  ride.input.encoder_counts[1] = static_cast<int32_t>(std::lround(-0.0021 * 100000));
  ride.input.encoder_counts[2] = static_cast<int32_t>(std::lround(z_m * 100000));
  constexpr uint32_t kOrigin[] = {params::kOriginX, params::kOriginY, params::kOriginZ};
  constexpr uint32_t kScene[] = {params::kSceneX, params::kSceneY, params::kSceneZ};
  if (tick < 3) command(kOrigin[tick], aside_m, ride.input);
  if (tick >= 3 && tick < 6) command(kScene[tick - 3], aside_m, ride.input);
}

}  // namespace

TEST(SceneSomeSizesAside_ContactIsCertain) {
  static const Asset asset(file_of(mesh_sections(scene_test::plate(0.01f), "plate")));
  constexpr double kSize_m = 0.1136;
  for (const double sizes : std::initializer_list<double>{1, 3, 4.5, 6, 10}) {
    const double aside_m = kSize_m * sizes / std::sqrt(3.0);
    const double top_m = static_cast<double>(static_cast<float>(aside_m));
    Ride ride(asset);
    test::note("tenths of a size", static_cast<uint32_t>(10 * sizes));
    uint32_t uncertain = 0, pushed = 0;
    for (uint32_t tick = 0; tick < 400; ++tick) {
      fill(tick, aside_m, ride);
      ride.step();
      if (tick >= 50) uncertain += (ride.output.state & record::kStateUncertain) != 0 ? 1u : 0u;
      pushed += ride.output.force_N[2] > 0.5f ? 1u : 0u;
      if (tick >= 100)
        CHECK_LE(std::fabs(static_cast<double>(ride.output.proxy_m[2]) - top_m - 0.003), 2e-6);
    }
    CHECK_EQ(uncertain, 0u);
    CHECK_GE(pushed, 250u);
    CHECK_EQ(ride.output.faults, 0u);
  }
}

}  // namespace firmtouch::controller_test
