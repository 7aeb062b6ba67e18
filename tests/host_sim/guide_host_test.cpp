// Guides in the closed loop: guide_drive moves a loose hand, or holds it.
#include <algorithm>
#include <cmath>
#include <string>

#include "harness/test.hpp"
#include "host_sim/controllers/session.hpp"
#include "host_sim/part_asset.hpp"

namespace host_sim = firmtouch::host_sim;
namespace record = firmtouch::record;
using firmtouch::test::part_asset;

namespace {

// A resting hand with the grip `grip`, at the start of the guide.
host_sim::Trace led(const std::string& grip, const std::string& lines) {
  const host_sim::Session session(part_asset());
  const host_sim::Environment environment = host_sim::environment_of(*session.controller, {});
  const host_sim::Vec at = environment.guide_at(0);
  const std::string start =
      std::to_string(at.x) + " " + std::to_string(at.y) + " " + std::to_string(at.z);
  host_sim::Scenario scenario = host_sim::read_scenario(
      "led.scenario",
      "asset part.fta\nmass 0.075 kg\nviscous_friction 0.5 N*s/m\nencoder_quantum 10 um\n"
      "contact_stiffness 0 N/m\nhand_damping 1 N*s/m\n" +
          grip + "\nstart " + start + " m\n" + lines,
      {}, host_sim::parameter_rows());
  host_sim::complete(scenario);
  return host_sim::run(scenario, *session.controller, environment, nullptr, {});
}

double size_of(const float (&v)[3]) {
  return std::hypot(static_cast<double>(v[0]), static_cast<double>(v[1]),
                    static_cast<double>(v[2]));
}

}  // namespace

TEST(GuideDrive_LooseHand_MovesAtDriveSpeed) {
  const host_sim::Session session(part_asset());
  const double length_m = static_cast<double>(session.controller->curve().head().length_m);
  const double round_s = length_m / 0.06;
  const host_sim::Trace trace =
      led("hand_stiffness 3 N/m",
          "guide_drive 2\nguide_drive_force 3 N\nguide_drive_speed 60 mm/s\nhold for " +
              std::to_string(2 * round_s) + " s\n");
  double way_m = 0, worst_m = 0, worst_N = 0;
  float before = 0;
  size_t backwards = 0;
  for (size_t i = trace.setup_ticks + 1000; i < trace.records.size(); ++i) {
    const record::TickOutput& out = trace.records[i].output;
    const float arc = out.guide_arc;
    float change = i == trace.setup_ticks + 1000 ? 0 : arc - before;
    change += change < -0.5f ? 1.0f : change > 0.5f ? -1.0f : 0.0f;
    if (change < -1e-3f) ++backwards;  // more than the encoder's grain
    way_m += static_cast<double>(change) * length_m;
    before = arc;
    CHECK((out.state & record::kStateOnGuide) != 0);
    worst_m = std::max(worst_m, static_cast<double>(out.guide_deviation_m));
    worst_N = std::max(worst_N, size_of(out.force_N));
  }
  const double wanted_m =
      0.06 * 1e-3 * static_cast<double>(trace.records.size() - trace.setup_ticks - 1000);
  CHECK_LE(std::abs(way_m / wanted_m - 1), 0.01);
  CHECK_EQ(backwards, 0u);
  CHECK_LE(worst_m, 0.002);
  CHECK_LE(worst_N, 8.0);
}

TEST(GuideHold_WeakerHand_DoesNotMove) {
  const host_sim::Trace trace =
      led("hand_stiffness 200 N/m",
          "guide_drive 2\nguide_drive_force 3 N\nguide_drive_speed 0 m/s\nhold for 1 s\n"
          "follow guide at 5 mm/s for 2 s\nhold for 1 s\n");
  // 10 mm at 200 N/m would be 2 N: the spring of 400 N/m gives way by a third of the way.
  const float first = trace.records[trace.setup_ticks + 900].output.guide_arc;
  float change = trace.records.back().output.guide_arc - first;
  change += change < -0.5f ? 1.0f : change > 0.5f ? -1.0f : 0.0f;
  const host_sim::Session session(part_asset());
  const double moved_m = static_cast<double>(change) *
                         static_cast<double>(session.controller->curve().head().length_m);
  CHECK_LE(std::abs(moved_m - 0.01 / 3), 0.0005);
}
