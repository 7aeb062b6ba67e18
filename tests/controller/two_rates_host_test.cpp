#include <thread>

#include "controller/ride.hpp"
#include "scene/proxy_rig.hpp"

// Geometry and servo at two rates: the model is made beside the ticks, and which one a tick uses is
// an input of it.
namespace firmtouch::controller_test {
namespace {

constexpr uint32_t kTicks = 3000;

struct Run {
  std::vector<record::TickRecord> records;
  uint32_t models = 0;
};

// Every tick's model is made as many ticks later as `late` says; the lines are the controller's
// own.
Run ride_with(uint32_t (*late)(uint32_t)) {
  Ride ride;
  Run run;
  uint32_t due = 0;
  bool is_due = false;
  for (uint32_t tick = 0; tick < kTicks; ++tick) {
    ride.fill(tick);
    ride.input.flags |= ride.controller.model_flags();
    if ((ride.input.flags & record::kFlagModelTaken) != 0) ++run.models;
    ride.step();
    if ((ride.input.flags & record::kFlagModelWanted) != 0) due = tick + late(tick), is_due = true;
    if (is_due && tick >= due) ride.controller.make_model(), is_due = false;
    run.records.push_back({ride.input, ride.output});
  }
  return run;
}

// Result: ticks whose bits differ when the inputs are given again, models made at once.
uint32_t differing_on_replay(const Run& run) {
  Ride again;
  uint32_t differing = 0;
  for (const record::TickRecord& recorded : run.records) {
    record::TickOutput output;
    again.controller.tick(recorded.input, output);
    again.controller.make_model();
    differing += std::memcmp(&output, &recorded.output, sizeof output) != 0;
  }
  return differing;
}

uint32_t at_once(uint32_t) { return 0; }
uint32_t now_and_then(uint32_t tick) { return tick * 2654435761u >> 31; }  // 0 or 1

TEST(TwoRates_TimeOfMakingAModel_ChangesNoBit) {
  for (const auto late : {at_once, now_and_then}) {
    const Run run = ride_with(late);
    CHECK_GE(run.models, kTicks / 3);
    CHECK_EQ(differing_on_replay(run), 0u);
    uint32_t pushed = 0;
    for (const record::TickRecord& one : run.records) pushed += size_of(one.output.force_N) > 0.1;
    CHECK_GE(pushed, kTicks / 10);
    CHECK_EQ(run.records.back().output.faults, 0u);
  }
  // It is an input: with one line taken away the replay differs.
  Run run = ride_with(at_once);
  for (uint32_t i = 500; i < kTicks; ++i) {
    if ((run.records[i].input.flags & record::kFlagModelTaken) == 0) continue;
    run.records[i].input.flags &= ~record::kFlagModelTaken;
    break;
  }
  CHECK_NE(differing_on_replay(run), 0u);
}

TEST(TheRecordKeepsWhichModelEachTickUsed) {
  const Run run = ride_with(now_and_then);
  uint32_t sequence = 0;
  for (const record::TickRecord& one : run.records) {
    if ((one.input.flags & record::kFlagModelTaken) != 0) ++sequence;
    CHECK_EQ(one.output.model_sequence, sequence);
  }
}

// As damaged inputs may say.
TEST(TwoRates_ModelWantedTwice_IsTheFirstOnes) {
  float expected_m = 0;
  for (const bool is_twice : {false, true}) {
    Ride ride;
    ride.fill(0);
    ride.input.flags |= record::kFlagModelApart | record::kFlagModelWanted;
    ride.step();
    ride.fill(500);
    ride.input.flags |= record::kFlagModelApart | (is_twice ? record::kFlagModelWanted : 0u);
    ride.step();
    ride.controller.make_model();
    ride.fill(501);
    ride.input.flags |= record::kFlagModelApart | record::kFlagModelTaken;
    ride.step();
    CHECK_GT(ride.output.distance_m, 0.0f);
    if (is_twice) CHECK_EQ(ride.output.distance_m, expected_m);
    expected_m = ride.output.distance_m;
  }
}

TEST(TwoRates_ModelsOfAThread_LogReplays) {
  Ride ride;
  bool is_over = false;
  std::thread geometry([&] {
    while (!__atomic_load_n(&is_over, __ATOMIC_ACQUIRE)) {
      ride.controller.make_model();
      std::this_thread::yield();
    }
  });
  Run run;
  for (uint32_t tick = 0; tick < kTicks; ++tick) {
    ride.fill(tick);
    ride.input.flags |= ride.controller.model_flags();
    ride.step();
    run.records.push_back({ride.input, ride.output});
    if (tick % 2 == 0) std::this_thread::yield();
  }
  __atomic_store_n(&is_over, true, __ATOMIC_RELEASE);
  geometry.join();
  CHECK_EQ(differing_on_replay(run), 0u);
}

TEST(StaleModel_RaisesAFault_ForceEnds) {
  Ride ride;
  for (uint32_t tick = 0; tick < 1000; ++tick) {
    ride.fill(tick);
    ride.input.flags |= ride.controller.model_flags();
    ride.step();
    ride.controller.make_model();
  }
  CHECK_EQ(ride.output.faults, 0u);
  uint32_t latched = 0;
  for (uint32_t tick = 1000; tick < 1030; ++tick) {
    ride.fill(tick);
    ride.input.flags |= ride.controller.model_flags();
    ride.step();
    if (ride.output.faults == 0) ++latched;
  }
  CHECK_EQ(ride.output.faults, servo::kFaultStaleModel);
  CHECK(latched <= static_cast<uint32_t>(params::kTable[params::kModelAge].initial) + 1);
  CHECK_EQ(size_of(ride.output.force_N), 0.0);
}

// A small tool that slides at 0.5 m/s, 3 mm deep: by more than its free ball a model.
TEST(TwoRates_SmallToolThatSlides_StaysInContact) {
  static const Asset asset(file_of(mesh_sections(scene_test::plate(0.01f), "plate")));
  Ride ride(asset);
  for (uint32_t tick = 0; tick < 240; ++tick) {
    const double x_m = tick < 120 ? -0.03 : -0.03 + 0.0005 * (tick - 120);
    const double z_m = tick < 120 ? std::max(0.005 - 0.0001 * tick, -0.003) : -0.003;
    ride.fill(tick);
    ride.input.encoder_counts[0] = static_cast<int32_t>(std::lround(x_m * 100000));
    ride.input.encoder_counts[1] = 0;
    ride.input.encoder_counts[2] = static_cast<int32_t>(std::lround(z_m * 100000));
    if (tick == 0) ride.input.command = params::kToolRadius + 1;
    ride.input.command_value = 0.0002f;
    ride.input.flags |= ride.controller.model_flags();
    ride.step();
    if (tick % 2 == 1) ride.controller.make_model();
    if (tick < 120) continue;
    CHECK((ride.output.state & record::kStateContact) != 0);
    CHECK_GE(ride.output.force_N[2], 1.0f);
  }
  CHECK_EQ(ride.output.faults, 0u);
}

}  // namespace
}  // namespace firmtouch::controller_test
