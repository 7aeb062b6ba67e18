// Force shading in a controller: off it changes no bit, on it turns the force of every way of
// making models, and what a hand gets is counted.
#include "firmtouch/controller/shaded.hpp"

#include "controller/ride.hpp"
#include "scene/proxy_rig.hpp"
#include "surface/random.hpp"

using namespace firmtouch;                   // NOLINT: a test file
using namespace firmtouch::controller_test;  // NOLINT: a test file

namespace {

using Bare = Controller<Surfaces<MeshSurface>>;
using Round = Controller<Shaded<Surfaces<MeshSurface>>>;

const Asset& drum() {
  static const Asset made(file_of(mesh_sections(scene_test::drum(0.02f, 0.03f, 12), "drum")));
  return made;
}

// A hand at an angle about the drum's axis, so deep below the circle of its corners.
template <class AnyController>
struct Hand {
  AnyController controller;
  record::TickInput input{};
  record::TickOutput output{};
  bool has_two_rates = false;
  double turn_rad = 0, given_J = 0, most_J = 0;

  Hand() { CHECK(controller.open(drum().bytes()).ok()); }

  bool set(uint32_t number, float value) {
    tick(0, -0.005, 1 + params::row_of(AnyController::kTable, number), value);
    return (output.state & record::kStateCommandTaken) != 0;
  }
  void tick(double angle, double deep_m, uint32_t command = 0, float value = 0) {
    const double away_m = 0.0205 - deep_m, x = away_m * std::cos(angle),
                 y = away_m * std::sin(angle);
    const double at_m[3] = {0.36 * x - 0.8 * y, 0.48 * x + 0.6 * y, -0.8 * x};
    const record::TickOutput last = output;
    input.tick = input.tick + 1;
    input.clock_us += 1000;
    input.flags = (input.tick < 10 ? 0 : record::kFlagEnable) |
                  (has_two_rates ? controller.model_flags() : 0);
    for (int k = 0; k < 3; ++k)
      input.encoder_counts[k] = static_cast<int32_t>(std::lround(at_m[k] * 1e6));
    input.command = command;
    input.command_value = value;
    controller.tick(input, output);
    if (has_two_rates) controller.make_model();
    double cosine = 0;
    for (int k = 0; k < 3; ++k) {
      const auto wide = [k](const float(&a)[3]) { return static_cast<double>(a[k]); };
      given_J += wide(last.force_N) * (wide(output.position_m) - wide(last.position_m));
      cosine += wide(last.force_N) * wide(output.force_N);
    }
    most_J = std::max(most_J, given_J);
    if (!(size_of(output.force_N) > 0)) given_J = 0;  // of this contact
    const double size_N2 = size_of(last.force_N) * size_of(output.force_N);
    if (size_N2 > 0.25) turn_rad = std::max(turn_rad, std::acos(std::min(1.0, cosine / size_N2)));
  }
  void begin() {
    for (const auto& [number, value] : {std::pair{params::kToolRadius, 0.0005f},
                                        {params::kCountsPerMetreX, 1e6f},
                                        {params::kCountsPerMetreY, 1e6f},
                                        {params::kCountsPerMetreZ, 1e6f}})
      CHECK(set(number, value));
    for (int i = 0; i < 300; ++i) tick(0.1, -0.003);
    for (int i = 0; i < 300; ++i) tick(0.1, -0.003 + i * 2e-5);
  }
  void slide() {
    begin();
    for (int i = 0; i < 4000; ++i) tick(0.1 + 0.0005 * i, 0.003);
    CHECK_EQ(output.faults, 0u);
  }
};

}  // namespace

TEST(Shaded_AtZero_HasTheSameBitsAsWithout) {
  Hand<Bare> bare;
  Hand<Round> round;
  bare.begin();
  round.begin();
  uint32_t differ = 0;
  for (int i = 0; i < 4000; ++i) {
    const double angle = 0.1 + 0.0005 * i, deep_m = 0.001 + 0.003 * std::sin(0.01 * i);
    bare.tick(angle, deep_m);
    round.tick(angle, deep_m);
    differ += std::memcmp(&bare.output, &round.output, sizeof bare.output) != 0;
  }
  CHECK_EQ(differ, 0u);
}

TEST(Shaded_OneRateAndTwo_TurnTheForceSlowlyOverEdges) {
  for (const bool has_two_rates : {false, true}) {
    Hand<Round> bare, round;
    bare.has_two_rates = round.has_two_rates = has_two_rates;
    CHECK(round.set(params::kContactShading, 0.01f));
    bare.slide();
    round.slide();
    CHECK_GE(bare.turn_rad, 0.2);
    CHECK_LE(round.turn_rad, 0.02);
  }
}

TEST(Shaded_BadRadius_IsRefused_AndChangedUnderLoadItMakesNoStep) {
  Hand<Round> bare, hand;
  for (const float bad : {NAN, -1e-9f, 0.1001f, INFINITY})
    CHECK(!hand.set(params::kContactShading, bad));
  CHECK(hand.set(params::kContactShading, 0.01f));
  const auto off_N = [](const record::TickOutput& a, const record::TickOutput& b) {
    return std::hypot(static_cast<double>(a.force_N[0] - b.force_N[0]),
                      static_cast<double>(a.force_N[1] - b.force_N[1]),
                      static_cast<double>(a.force_N[2] - b.force_N[2]));
  };
  bare.begin();
  hand.begin();
  double angle = 0.1;
  while (angle < 0.7 && off_N(bare.output, hand.output) < 0.3) {
    bare.tick(angle += 5e-4, 0.003);
    hand.tick(angle, 0.003);
  }
  CHECK_LE(angle, 0.6);  // where the corner is
  const record::TickOutput stood = hand.output;
  hand.tick(angle, 0.003, 1 + params::row_of(Round::kTable, params::kContactShading), 0.0f);
  CHECK_NE(hand.output.state & record::kStateCommandTaken, 0u);
  CHECK_LE(off_N(stood, hand.output), 0.01);
  for (int i = 0; i < 10; ++i) hand.tick(angle += 5e-4, 0.003), bare.tick(angle, 0.003);
  for (int i = 0; i < 50; ++i) hand.tick(angle, 0.003), bare.tick(angle, 0.003);
  CHECK_LE(off_N(bare.output, hand.output), 1e-4);
}

// A reservoir of nothing, on a device without friction: the observer counts the shaded force.
TEST(Shaded_EmptyReservoir_HandsOverEdgesAreGivenNothing) {
  Hand<Round> hand;
  CHECK(hand.set(params::kContactShading, 0.01f));
  CHECK(hand.set(params::kEnergyReservoir, 0.0f));
  CHECK(hand.set(params::kDeviceDamping, 0.0f));
  hand.begin();
  tools::Random random(11);
  double angle = 0.1, deep_m = 0.0029;
  for (int leg = 0; leg < 300; ++leg) {
    const double to = random.between(0, 1.5), deep_to_m = random.between(-0.001, 0.004);
    const int steps = 50 + static_cast<int>(std::fabs(to - angle) * 1000);
    for (int i = 1; i <= steps; ++i) {
      const double share = 0.5 - 0.5 * std::cos(3.14159265358979 * i / steps);
      hand.tick(angle + (to - angle) * share, deep_m + (deep_to_m - deep_m) * share);
    }
    angle = to, deep_m = deep_to_m;
  }
  CHECK_LE(hand.most_J, 2e-5);
}
