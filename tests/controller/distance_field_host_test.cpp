// A controller whose asset has a distance field of its mesh.
#include <cmath>
#include <cstdint>

#include "controller/ride.hpp"
#include "firmtouch/field/layout.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using namespace controller_test;

namespace {

std::vector<tools::Section> sections_with_field() {
  std::vector<tools::Section> sections = both_sections();
  for (tools::Section& section : distance_field_sections(sections))
    sections.push_back(std::move(section));
  return sections;
}

const Asset& asset_with_field() {
  static const Asset made(file_of(sections_with_field()));
  return made;
}

// Up and away from the part and back to it, twenty times in 6,000 ticks.
void fill_far(Ride& ride, uint32_t tick) {
  ride.fill(tick);
  const double up_m = 0.05 * (1 - std::cos(0.021 * tick));
  ride.input.encoder_counts[2] += static_cast<int32_t>(std::lround(up_m * 100000));
}

}  // namespace

TEST(Field_OneCellATickInFreeSpace_SameContact) {
  Ride with(asset_with_field()), without;
  CHECK(with.controller.distance_field().is_open() &&
        !without.controller.distance_field().is_open());
  uint32_t far = 0, contact = 0;
  uint64_t steps_with = 0, steps_without = 0;
  double free_with_m = 0, free_without_m = 0;
  for (uint32_t tick = 0; tick < 6000; ++tick) {
    fill_far(with, tick);
    without.input = with.input;
    with.step();
    without.step();
    const record::TickOutput &a = with.output, &b = without.output;
    CHECK(all_finite(a));
    for (int k = 0; k < 3; ++k)
      CHECK_LE(std::fabs(double{a.motor_N[k]} - double{b.motor_N[k]}), 1e-3);
    CHECK_LE(std::fabs(double{a.penetration_m} - double{b.penetration_m}), 1e-7);
    CHECK_LE(a.distance_lower_m, std::fabs(a.distance_m));
    contact += (a.state & record::kStateContact) != 0 ? 1 : 0;
    if ((a.state & record::kStateExact) == 0 && tick > 0) {
      far += a.steps - a.guide_steps == 1 ? 1 : 0;
      free_with_m += double{a.distance_lower_m};
      free_without_m += double{b.distance_lower_m};
      CHECK_EQ(a.state >> record::kStateSignShift & 3u, 2u);  // outside
    }
    steps_with += a.steps - a.guide_steps;
    steps_without += b.steps - b.guide_steps;
  }
  CHECK_EQ(with.output.faults | without.output.faults, 0u);
  CHECK_GE(far, 3000u);
  CHECK_GE(contact, 100u);
  CHECK_LT(steps_with, steps_without);
  CHECK_GT(free_with_m, 5 * free_without_m);
}

TEST(RideWithAField_IsAFunctionOfItsInputs) {
  Ride a(asset_with_field()), b(asset_with_field());
  CHECK_EQ(differing_ticks(a, b, 2000, fill_far), 0u);
}

TEST(FieldThatItsMeshDoesNotProve_IsRejected_NoForce) {
  std::vector<tools::Section> sections = sections_with_field();
  for (tools::Section& section : sections) {
    if (section.type == field::kDistancesSection)  // a cell in the middle: farther than it is
      section.bytes[section.bytes.size() / 2] =
          static_cast<uint8_t>(section.bytes[section.bytes.size() / 2] + 40);
  }
  const Asset bent(file_of(std::move(sections)));
  FullController controller;
  CHECK_EQ(controller.open(bent.bytes()).rule, uint16_t{310});
  CHECK(!controller.distance_field().is_open());
  CHECK_EQ(faults_when_enabled(controller), servo::kFaultAsset);
}

TEST(FieldOfAnotherName_IsNotTheMeshs) {
  std::vector<tools::Section> sections = sections_with_field();
  for (tools::Section& section : sections) {
    if (section.type == field::kHeadSection || section.type == field::kDistancesSection ||
        section.type == field::kSeedsSection)
      section.name = "path";
  }
  const Asset other(file_of(std::move(sections)));
  Ride ride(other);
  CHECK(ride.controller.is_ready() && !ride.controller.distance_field().is_open());
}

TEST(Field_IsProvenInSlicesOfTheBudget) {
  FullController controller;
  controller.begin(asset_with_field().bytes());
  const uint32_t slices = slices_behind_the_curve(
      controller, 250, [&] { return controller.distance_field().is_open(); });
  const field::Head& head = controller.distance_field().head();
  CHECK_GE(slices, head.count[0] * head.count[1] * head.count[2] / 9);
  controller.begin(both().bytes());  // and is forgotten with its asset
  CHECK(!controller.distance_field().is_open());
  while (!controller.work(1u << 20)) {
  }
  CHECK(controller.is_ready() && !controller.distance_field().is_open());
}
