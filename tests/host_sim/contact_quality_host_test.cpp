// How a contact feels, against closed forms.
#include <cmath>
#include <initializer_list>
#include <string>

#include "harness/test.hpp"
#include "host_sim/report/contact_quality.hpp"
#include "host_sim/report/summary.hpp"

namespace host_sim = firmtouch::host_sim;
namespace record = firmtouch::record;
using host_sim::ContactQuality;
using host_sim::Vec;

namespace {

constexpr double kRate_Hz = 1000, kLimit_N = 8, kPi = 3.14159265358979323846;

// A meter, and the turns of its contact.
struct Meter : ContactQuality {
  host_sim::ContactTurn turn;
  Meter() : ContactQuality(kRate_Hz, kLimit_N) {}
  void take(const record::TickOutput& out, bool motors_are_on = true) {
    const Vec contact_N = host_sim::contact_force_N(out, 1000);
    add(host_sim::wide(out.force_N), contact_N, turn.add_rad(out, contact_N), motors_are_on);
  }
};

// A tick without a guide.
void add(Meter& meter, Vec force_N, bool motors_are_on = true) {
  meter.add(force_N, force_N, meter.turn.add_rad({}, force_N), motors_are_on);
}

// One second of a force of 2 N along z with a sine of `amplitude_N` on it.
Meter after_sine(double frequency_Hz, double amplitude_N, bool motors_are_on = true) {
  Meter meter;
  for (int i = 0; i < 1000; ++i)
    add(meter, {0, 0, 2 + amplitude_N * std::sin(2 * kPi * frequency_Hz * i / kRate_Hz)},
        motors_are_on);
  return meter;
}

constexpr double kLength_m = 1e-3, kSlope = 0.7;

// A mesh at the origin whose material 1 has waves along x.
host_sim::Environment environment_of_waves() {
  host_sim::Environment environment({host_sim::PlacedMesh{}}, {}, {}, {});
  environment.name_materials({"waves", "smooth"});
  environment.set_textures(
      {{{{{static_cast<float>(1 / kLength_m), 0, 0}, static_cast<float>(kSlope * kLength_m / kPi)},
         {}}},
       {}});
  return environment;
}

record::TickOutput touching(uint32_t material, double x_m) {
  record::TickOutput out{};
  out.state = record::kStateProxy | record::kStateContact | material << record::kStateMaterialShift;
  out.position_m[0] = static_cast<float>(x_m);
  return out;
}

// A tick pressed 2 mm deep along z on a spring of 1,000 N/m, and pulled back by a guide.
record::TickOutput guided(float x_N, float z_N) {
  record::TickOutput out{};
  out.state = record::kStateProxy | record::kStateContact | record::kStateOnGuide;
  out.proxy_m[2] = 0.002f;
  out.force_N[0] = x_N;
  out.force_N[2] = z_N;
  return out;
}

// Which figures are too much, and beside which limit.
std::string quality_of(host_sim::Summary summary) {
  summary.contact_ticks = summary.ticks = 1000;
  summary.tool_radius_m = 3e-3;
  summary.force_limit_N = kLimit_N;
  const std::string text = host_sim::text_of(summary, {});
  const size_t at = text.find("  feel ");
  return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
}

}  // namespace

TEST(Chatter_FastSine_IsItsRootMeanSquare) {
  const Meter meter = after_sine(200, 1);
  CHECK_LT(std::fabs(meter.chatter_N() - std::sqrt(0.5)), 0.02);
  CHECK_LT(0.9, meter.chatter_s());
}

// A Butterworth filter of second order passes 1 / sqrt(1 + (50 / f)^4).
TEST(Chatter_SlowSine_IsOfTheHand) {
  CHECK_LT(after_sine(5, 1).chatter_N(), 0.02);
  CHECK(!(after_sine(5, 1).chatter_s() > 0));
  CHECK_LT(std::fabs(after_sine(50, 1).chatter_N() - 0.5), 0.05);
}

TEST(Chatter_MotorsOff_IsZero) { CHECK(!(after_sine(200, 4, false).chatter_N() > 0)); }

// The trial that every card called good: a force between 0 and 8 N for 4 s.
TEST(Chatter_LimitCycleOfHalfTheRate_IsLong) {
  Meter meter;
  for (int i = 0; i < 4000; ++i) add(meter, {0, 0, i % 8 < 4 ? 8.0 : 0.0});
  CHECK_LT(3.5, meter.chatter_N());
  CHECK_LT(3.8, meter.chatter_s());
}

TEST(Turn_IsTheLargestAngleBetweenTwoTicks) {
  Meter meter;
  for (const double angle_rad : {0.0, 0.1, 0.35, 0.4}) {
    const Vec force_N{std::cos(angle_rad), 0, std::sin(angle_rad)};
    add(meter, force_N);
  }
  CHECK_LT(std::fabs(meter.turn_rad() - 0.25), 1e-9);
}

// Next to nothing has no direction: 5 % of the limit.
TEST(Turn_OfAFaintForce_IsLeftOut) {
  Meter meter;
  add(meter, {0.3, 0, 0});
  add(meter, {0, 0.3, 0});
  CHECK(!(meter.turn_rad() > 0));
}

// Guide and contact that pull against each other leave little of either, of any direction. Only
// what the contact does is a turn of contact; what the guide does is a step of the guide.
TEST(Turn_GuideCancelsContact_IsTheContactsOwn) {
  Meter meter;
  meter.take(guided(0, 0.5f));
  meter.take(guided(0.5f, 0));
  meter.take(guided(0, -0.5f));
  CHECK_LT(meter.turn_rad(), 1e-9);
  CHECK_LT(std::fabs(meter.guide_step_N() - std::sqrt(0.5)), 1e-9);
  record::TickOutput turned = guided(0, -0.5f);
  turned.proxy_m[0] = 0.002f;
  meter.take(turned);
  CHECK_LT(std::fabs(meter.turn_rad() - kPi / 4), 1e-9);
  CHECK_LT(std::fabs(meter.guide_step_N() - std::sqrt(0.5)), 1e-9);  // the force does not step
}

// Where the motors limit the force of both, the spring alone says 36 N.
TEST(Guide_BesideASpringBeyondTheMotors_StepsByNoMoreThanTheForce) {
  Meter meter;
  for (int i = 0; i < 10; ++i) {
    record::TickOutput out = guided(i % 2 == 0 ? 0.3f : 0.4f, 2);
    out.proxy_m[2] = i % 3 == 0 ? 0.036f : 0.001f;
    meter.take(out);
  }
  CHECK_LT(std::fabs(meter.guide_step_N() - 0.1), 1e-6);
}

// What is left of the force of a guide that has let go, and falls by the slew limit, is no contact.
TEST(Turn_WithoutContact_IsOfNoForce) {
  record::TickOutput out = guided(2, 0);
  out.state &= ~uint32_t{record::kStateContact | record::kStateOnGuide};
  CHECK(!(host_sim::norm(host_sim::contact_force_N(out, 1000)) > 0));
}

// Steep waves under a tool that goes on by half of one: the force turns by 70 degrees, as n + slope
// says. A wall that the tool leaves in the same tick turns it, too: that is not the texture's.
TEST(Turn_OfATexture_IsLeftOut_AndOfAWallBesideItIsNot) {
  const host_sim::Environment environment = environment_of_waves();
  const Vec wall{0, 0.6, 0.8};
  for (const double share : {1.0, 0.5})
    for (const Vec& first : {Vec{0, 0, 1}, wall}) {
      host_sim::ContactTurn turn(&environment), plain;
      double found_rad = 0, plain_rad = 0;
      for (const double waves : {-0.25, 0.25}) {
        const record::TickOutput out = touching(1, waves * kLength_m);
        const Vec n = waves < 0 ? first : Vec{0, 0, 1};
        const Vec contact_N = (n + Vec{share * kSlope * std::sin(2 * kPi * waves), 0, 0}) * 2;
        found_rad = turn.add_rad(out, contact_N);
        plain_rad = plain.add_rad(out, contact_N);
      }
      if (first.y > 0) {
        CHECK_LT(std::fabs(found_rad - std::asin(0.6)), 0.05);
        continue;
      }
      CHECK_LT(found_rad, 1e-5);
      CHECK_LT(std::fabs(plain_rad - 2 * std::atan(share * kSlope)), 1e-5);
    }
}

// Another material without waves, none, and free motion: no texture.
TEST(Turn_WhereNoTextureIsTouched_IsWhole) {
  const host_sim::Environment environment = environment_of_waves();
  for (const uint32_t material : {0u, 2u, 255u}) {
    host_sim::ContactTurn turn(&environment);
    turn.add_rad(touching(material, -0.25 * kLength_m), {-kSlope, 0, 1});
    CHECK_LT(std::fabs(turn.add_rad(touching(material, 0.25 * kLength_m), {kSlope, 0, 1}) -
                       2 * std::atan(kSlope)),
             1e-12);
  }
}

// Behind a border the texture of the material before goes on, with a share.
TEST(Turn_BehindABorder_IsThatOfTheTextureBefore) {
  const host_sim::Environment environment = environment_of_waves();
  host_sim::ContactTurn turn(&environment);
  turn.add_rad(touching(1, -0.25 * kLength_m), {-0.75 * kSlope, 0, 1});
  CHECK_LT(turn.add_rad(touching(2, 0.25 * kLength_m), {0.75 * kSlope, 0, 1}), 1e-5);
  CHECK_LT(turn.add_rad(touching(2, -0.25 * kLength_m), {-0.74 * kSlope, 0, 1}), 0.02);
  turn.add_rad({}, {0, 0, 1});  // let go
  turn.add_rad(touching(2, 0.25 * kLength_m), {kSlope, 0, 1});
  CHECK_GE(turn.add_rad(touching(2, -0.25 * kLength_m), {-kSlope, 0, 1}), 1.0);
}

// Without a surface no tick has a proxy: a guide of two branches that pulls back and forth is no
// contact, on the guide and while its force falls.
TEST(Turn_OfAGuideWithoutASurface_IsAStepOfTheGuide) {
  for (const uint32_t on_guide : {uint32_t{record::kStateOnGuide}, 0u}) {
    Meter meter;
    for (const float x_N : {2.0f, -1.0f, 0.0f}) {
      record::TickOutput out{};
      out.state = on_guide;
      out.force_N[0] = x_N;
      meter.take(out);
      CHECK(!(host_sim::norm(host_sim::contact_force_N(out, 1000)) > 0));
    }
    CHECK(!(meter.turn_rad() > 0));
    CHECK_LT(std::fabs(meter.guide_step_N() - 3), 1e-12);
  }
}

TEST(Turn_WithoutProxyOrGuide_IsOfTheWholeForce) {
  for (const uint32_t bit : {uint32_t{record::kStateProxy}, uint32_t{record::kStateOnGuide}}) {
    record::TickOutput out = guided(0.5f, 0.25f);
    out.state &= ~bit;
    const Vec contact_N = host_sim::contact_force_N(out, 1000);
    CHECK_LT(host_sim::norm(contact_N - Vec{0.5, 0, 0.25}), 1e-12);
  }
  record::TickOutput free = guided(0.5f, 0.25f);
  free.state &= ~uint32_t{record::kStateContact};
  CHECK(!(host_sim::norm(host_sim::contact_force_N(free, 1000)) > 0));
}

TEST(Quality_OfARun_NamesWhatIsTooMuch) {
  const auto says = [](const host_sim::Summary& summary, const char* what) {
    const std::string line = quality_of(summary);
    const size_t bad = line.find("BAD");
    return line.find(what) != std::string::npos && line.find("BAD", bad + 1) == std::string::npos;
  };
  host_sim::Summary at_limit, deep, chatters, turns, calm;
  at_limit.limit_ticks = 11;
  deep.worst_penetration_m = 3.3e-3;
  chatters.chatter_s = 0.6;
  turns.worst_turn_rad = 21 / 57.29577951308232;
  CHECK(says(at_limit, "11 ticks at the force limit (BAD: more than 1 % of all);"));
  CHECK(says(deep, "deepest 1.10 tool radii (BAD: more than 1);"));
  CHECK(says(chatters, "above 50 Hz (BAD: for 0.60 s more than 0.20 N);"));
  CHECK(says(turns, "turn of contact 21.0 degrees a tick (BAD: more than 20)"));
  calm.limit_ticks = 10;
  calm.worst_penetration_m = 2.9e-3;
  calm.chatter_s = 0.4;
  calm.worst_turn_rad = 19 / 57.29577951308232;
  CHECK(!quality_of(calm).empty() && quality_of(calm).find("BAD") == std::string::npos);
  deep.has_proxy = true;  // which has a way out at any depth
  CHECK(quality_of(deep).find("BAD") == std::string::npos);
}
