// A controller whose asset carries a hull of its mesh, with too little time for the mesh.
#include <cstdint>

#include "controller/ride.hpp"
#include "firmtouch/hull/layout.hpp"
#include "harness/test.hpp"
#include "hull/add_hull.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace controller_test;

namespace {

std::vector<tools::Section> hulled_sections() {
  std::vector<tools::Section> sections = both_sections();
  hull_test::add_hull(sections, 600);
  return sections;
}

const Asset& hulled() {
  static const Asset made(file_of(hulled_sections()));
  return made;
}

// With `steps` for the mesh from the first tick on.
void fill_short(Ride& ride, uint32_t tick, float steps) {
  ride.fill(tick);
  if (tick != 0) return;
  ride.input.command = 1 + params::kMeshWork;
  ride.input.command_value = steps;
}

}  // namespace

TEST(BudgetExhausted_BaseHullIsTouchedAndRecorded) {
  Ride cut_off(hulled()), exact;
  CHECK(cut_off.controller.hull().is_open() && !exact.controller.hull().is_open());
  uint32_t of_base_hull = 0, contact = 0, late = 0, reported_exact = 0;
  for (uint32_t tick = 0; tick < 6000; ++tick) {
    fill_short(cut_off, tick, 16);
    exact.fill(tick);
    cut_off.step();
    exact.step();
    const record::TickOutput &a = cut_off.output, &b = exact.output;
    CHECK(all_finite(a));
    CHECK_LE(size_of(a.motor_N), 8.0);
    of_base_hull += (a.state & record::kStateOfBaseHull) != 0 ? 1u : 0u;
    reported_exact +=
        (a.state & record::kStateOfBaseHull) != 0 && (a.state & record::kStateExact) != 0;
    CHECK_EQ(b.state & record::kStateOfBaseHull, 0u);
    if (tick < 12 || (b.state & record::kStateExact) == 0) continue;
    contact += (b.state & record::kStateContact) != 0 ? 1u : 0u;
    late += a.penetration_m < b.penetration_m - 2e-6f ? 1u : 0u;
  }
  CHECK_EQ(cut_off.output.faults, 0u);
  CHECK_LT(100u, of_base_hull);
  CHECK_LT(1000u, contact);
  CHECK_EQ(late, 0u);
  CHECK_EQ(reported_exact, 0u);
}

TEST(ARideByTheHullIsAFunctionOfItsInputs) {
  Ride a(hulled()), b(hulled());
  const auto fill = [](Ride& ride, uint32_t tick) { fill_short(ride, tick, 16); };
  CHECK_EQ(differing_ticks(a, b, 2000, fill), 0u);
}

TEST(Hull_UnprovenOrOtherProbeAnswers_KeepsTheMotorsOff) {
  for (const uint32_t type : {hull::kProbesSection, hull::kBaseHullSection}) {
    std::vector<tools::Section> sections = hulled_sections();
    for (tools::Section& section : sections) {
      if (section.type != type) continue;
      const size_t at = type == hull::kProbesSection ? 8 : section.bytes.size() / 2;
      section.bytes[at] = static_cast<uint8_t>(section.bytes[at] ^ 1u);
    }
    const Asset bent(file_of(std::move(sections)));
    FullController controller;
    const uint16_t rule = controller.open(bent.bytes()).rule;
    if (type == hull::kProbesSection) {
      CHECK_EQ(rule, firmtouch::kRuleHullProbes);
    } else {
      CHECK(rule >= 540 && rule <= 549);
    }
    CHECK_NE(faults_when_enabled(controller), 0u);
  }
}

TEST(AHullIsProvenInSlicesOfTheBudget) {
  FullController controller;
  controller.begin(hulled().bytes());
  const uint32_t slices =
      slices_behind_the_curve(controller, 2048, [&] { return controller.hull().is_open(); });
  CHECK_GE(slices, controller.hull().id_count() / 200);
  controller.begin(both().bytes());  // and is forgotten with its asset
  CHECK(!controller.hull().is_open());
  while (!controller.work(1u << 20)) {
  }
  CHECK(controller.is_ready() && !controller.hull().is_open());
}
