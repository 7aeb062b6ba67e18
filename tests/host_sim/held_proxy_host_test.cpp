// The planes, the spring and the friction that a report draws, against solids whose normals are
// known.
#include "host_sim/report/held_proxy.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "harness/test.hpp"
#include "host_sim/bench/rig.hpp"

namespace firmtouch::host_sim {
namespace {

struct HeldTick {
  HeldProxy held;
  record::TickOutput out;
};

// A tool of 3 mm over the corner of three walls at 0, normals x, y and z.
std::vector<HeldTick> run(const std::vector<std::string>& script, const Lines& settings = {},
                          Contact contact = Contact::kProxy) {
  const Rig rig(0);
  const Session session(rig.bake(three_walls()), {}, contact);
  const Environment environment;
  const Scenario scenario = rig.scenario({0.02, 0.02, 0.02}, script, settings);
  Simulation simulation(scenario, session.tick(), environment);
  HeldProxies proxies(session);
  std::vector<HeldTick> ticks;
  for (RunTick tick; simulation.next(tick);)
    ticks.push_back({proxies.after(tick.record), tick.record.output});
  return ticks;
}

// Whether the planes of the last tick are those of these axes, and the hand is behind each.
void check_normals(const std::vector<HeldTick>& ticks, const std::string& axes) {
  const HeldProxy& held = ticks.back().held;
  CHECK_EQ(held.normals.size(), axes.size());
  CHECK_EQ(held.kind, static_cast<char>('0' + axes.size()));
  for (const char axis : axes) {
    const Vec wanted{axis == 'x' ? 1.0 : 0.0, axis == 'y' ? 1.0 : 0.0, axis == 'z' ? 1.0 : 0.0};
    double off = 1;
    for (const Vec& normal : held.normals) off = std::min(off, norm(normal - wanted));
    CHECK_LT(off, 1e-5);
    CHECK_LT(dot(held.hand_m, wanted), -1e-3);
  }
  const record::TickOutput& out = ticks.back().out;
  CHECK_LT(norm(held.hand_m - (wide(out.position_m) - wide(out.proxy_m))), 1e-7);
}

TEST(HeldProxy_OnOneTwoThreeWalls_HasTheirNormalsAlsoAtTwoRates) {
  const Lines one_rate, two_rates = {{"geometry_rate", "200 Hz"}};
  for (const Lines& settings : {one_rate, two_rates}) {
    check_normals(run({Rig::to({0.02, 0.02, -0.003}, 0.1), Rig::hold_s(0.3)}, settings), "z");
    check_normals(run({Rig::to({-0.003, 0.02, -0.003}, 0.1), Rig::hold_s(0.3)}, settings), "xz");
    check_normals(run({Rig::to({-0.003, -0.003, -0.003}, 0.1), Rig::hold_s(0.3)}, settings), "xyz");
  }
}

// The proxy stands still for the 10 ticks of a model, and its planes are those of that model.
TEST(HeldProxy_AtTwoRates_IsThatOfTheModelInUse) {
  const std::vector<HeldTick> ticks =
      run({Rig::to({0.02, 0.02, -0.003}, 0.1), Rig::to({-0.003, 0.02, -0.003}, 0.05)},
          {{"geometry_rate", "100 Hz"}});
  double off_m = 0;
  uint32_t held = 0;
  for (const HeldTick& tick : ticks) {
    if (tick.held.normals.empty()) continue;
    ++held;
    const Vec hand_m = wide(tick.out.position_m) - wide(tick.out.proxy_m);
    off_m = std::max(off_m, norm(tick.held.hand_m - hand_m));
  }
  CHECK_LT(off_m, 1e-7);
  CHECK_LT(400u, held);
  CHECK_EQ(ticks.back().held.kind, '2');
}

// At 50 mm/s friction is that of a slide: so steep stands the hand.
TEST(HeldProxy_OfASlide_HasTheHandOnTheConeOfFriction) {
  const std::vector<HeldTick> ticks =
      run({Rig::to({0.02, 0.02, -0.003}, 0.1), Rig::to({0.01, 0.02, -0.003}, 0.05)},
          {{"friction_static", "0.6"}, {"friction_dynamic", "0.3"}});
  const HeldProxy& held = ticks.back().held;
  CHECK_EQ(held.kind, '1');
  CHECK_LT(std::fabs(held.friction_static - 0.6), 1e-6);
  CHECK_LT(std::fabs(held.friction_dynamic - 0.3), 1e-6);
  const double across_m = dot(held.hand_m, held.normals[0]);
  const double along_m = norm(held.hand_m - held.normals[0] * across_m);
  CHECK_LT(std::fabs(along_m / -across_m - 0.3), 0.003);
}

TEST(HeldProxy_WithoutContactOrProxy_HasNoPlanes) {
  for (const HeldTick& tick : run({Rig::to({0.02, 0.02, 0.01}, 0.1)}))
    CHECK(tick.held.kind == '-' && tick.held.normals.empty());
  const std::vector<HeldTick> penalty =
      run({Rig::to({0.02, 0.02, -0.003}, 0.1)}, {}, Contact::kPenalty);
  CHECK_EQ(penalty.front().held.kind, '-');
  CHECK(penalty.back().held.kind == 'p' && penalty.back().held.normals.empty());
}

}  // namespace
}  // namespace firmtouch::host_sim
