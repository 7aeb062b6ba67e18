// Energy that contact through a linkage gives to a hand: the seeds are those that gained most while
// the observer counted forces that weak motors did not render, or the tip's way instead of the
// joints'.
#include "harness/test.hpp"
#include "host_sim/bench/passive_hands.hpp"

using namespace firmtouch::host_sim;  // NOLINT: a test file

TEST(Passivity_HandsOnLinkages_GainNoMoreThanAMillijoule) {
  const struct {
    const char* machine;
    uint64_t seed;
  } kHands[] = {
      {"haply_pantograph", 9}, {"touch_like", 9}, {"pantograph_mk2", 9}, {"pantograph_mk2", 16}};
  for (const auto& hand : kHands) {
    const RigRun run = random_run(hand.machine, 20000, hand.seed, {});
    CHECK_LE(gain_J(run), 0.001);
    CHECK_EQ(run.back().faults, 0u);
  }
}

TEST(Passivity_WithoutALimit_ALinkageGivesMore) {
  CHECK_GE(gain_J(random_run("touch_like", 20000, 1, {{"energy_reservoir", "1000 J"}})), 0.001);
}
