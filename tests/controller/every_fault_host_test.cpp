// Every fault, begun at every tick of eight scenarios: named as SAFETY.md says, no force after the
// ticks that it says, and no step of the force above the slew limit except where it says that the
// force is cut.
#include <cstdio>
#include <functional>
#include <memory>
#include <utility>

#include "bake/asset/origin.hpp"
#include "controller/every_fault.hpp"
#include "controller/joints_rig.hpp"
#include "scene/proxy_rig.hpp"

namespace firmtouch::controller_test {
namespace {

using Setting = std::pair<uint32_t, float>;
struct Scenario {
  const Asset* asset;
  uint32_t ticks;
  std::vector<Setting> settings;
  // The hand, and what is commanded.
  std::function<void(record::TickInput& input, const record::TickOutput& last)> hand;
  bool is_apart = false;  // at two rates
  const Asset* next = nullptr;
};

constexpr uint32_t kEnabled = 14;  // its first tick; settings are set before
constexpr uint32_t kBehind = 100;  // ticks after the last one that begins a fault
constexpr double kLimit_N = 8, kStep_N = 1, kMaxTorque_Nm = 2,
                 kRise_Nm = 1;  // a tick; arm_layout()

bool is_on(const record::TickOutput& output) {
  const uint32_t mode = output.state & record::kStateServoMask;
  return mode == static_cast<uint32_t>(servo::Mode::kRampIn) ||
         mode == static_cast<uint32_t>(servo::Mode::kOn);
}
bool is_homed(const record::TickOutput& output) {
  return (output.state & record::kStateNotHomed) == 0;
}

class Matrix {
 public:
  explicit Matrix(const Scenario& scenario) : scenario_(scenario) {
    open();
    is_linkage_ = controller_->device().linkage().is_open();
    record::TickOutput output{};
    for (uint32_t tick = 0; tick < scenario_.ticks + kBehind; ++tick) {
      record::TickInput input{};
      input.tick = tick;
      input.clock_us = 4294900000u + tick * 1000u;  // wraps
      input.flags = (tick < kEnabled ? 0 : record::kFlagEnable) |
                    (scenario_.is_apart ? controller_->model_flags() : 0);
      if (tick < scenario_.settings.size())
        command(input, scenario_.settings[tick].first, scenario_.settings[tick].second);
      scenario_.hand(input, output);
      step(input, output);
      CHECK((output.state & record::kStateCommandRefused) == 0);
      inputs_.push_back(input);
      outputs_.push_back(output);
    }
    CHECK_EQ(output.faults, 0u);
  }

  // Each case begins with a copy of all of the controller's state, at the same address.
  void run() {
    open();
    std::vector<unsigned char> bytes(sizeof(Tested));
    for (uint32_t tick = 0; tick < scenario_.ticks; ++tick) {
      std::memcpy(bytes.data(), controller_.get(), sizeof(Tested));
      for (const Plan& plan : kPlans) {
        if (tick < kEnabled) continue;
        const char* problem = wrong(plan, tick);
        if (problem != nullptr) std::printf("%s at tick %u: %s\n", plan.name, tick, problem);
        CHECK(problem == nullptr);
        g_bad = kGood;
        std::memcpy(static_cast<void*>(controller_.get()), bytes.data(), sizeof(Tested));
      }
      record::TickOutput output;
      step(inputs_[tick], output);
      CHECK(std::memcmp(&output, &outputs_[tick], sizeof output) == 0);
    }
    CHECK_GE(loaded_, scenario_.ticks / 4);
  }

 private:
  void open() {
    controller_.reset(new Tested);
    CHECK_EQ(controller_->open(scenario_.asset->bytes()).rule, 0u);
    if (scenario_.next != nullptr) controller_->begin_next(scenario_.next->bytes());
    while (scenario_.next != nullptr && !controller_->work_next(kSliceUnits)) {
    }
  }
  void step(const record::TickInput& input, record::TickOutput& output) {
    std::memset(&output, 0xA5, sizeof output);  // a tick writes all of it
    controller_->tick(input, output);
    if (scenario_.is_apart) controller_->make_model();
  }

  // Faults that may be named: where motors home, what inputs do is homing's. Of a linkage's first
  // sample nobody knows whether it leaps.
  uint32_t named(const Plan& plan, uint32_t at) const {
    const bool is_input = plan.reaction != kCut && !is_homed(outputs_[at]);
    const uint32_t homing = is_input ? servo::kFaultHoming : 0;
    const bool is_first = plan.bend == leap && !is_homed(outputs_[at - 1]);
    return plan.fault | homing | (is_first ? servo::kFaultWorkspace : 0);
  }
  // Ticks in which it must react; none where it need not: before the motors come on, and where a
  // fault needs a model, a wall, or an axis along the force.
  uint32_t within(const Plan& plan, uint32_t at) const {
    const record::TickOutput &was = outputs_[at - 1], &now = outputs_[at];
    const uint32_t most = plan.within_ticks;
    if (plan.bend == outrun && (is_linkage_ || now.penetration_m < 3e-4f)) return 0;
    if (plan.bend == outrun && size_of(now.force_N) < 0.2) return 0;
    if (plan.bend == be_uncertain && !is_on(was)) return 0;
    if (plan.bend == be_uncertain || plan.bend == squeeze || plan.bend == spoil_model)
      return is_homed(now) ? most + (scenario_.is_apart ? 2 : 0) : 0;
    if (!is_homed(now) && (plan.bend == lose || plan.bend == leap))
      return at > kEnabled ? most + 1 : 0;
    return is_on(now) || (plan.fault & servo::kOnlyWhileOn) == 0 ? most : 0;
  }

  // Begins a fault. Result: what SAFETY.md does not allow, or null.
  const char* wrong(const Plan& plan, uint32_t at) {
    const uint32_t names = named(plan, at), most = within(plan, at);
    record::TickOutput before = outputs_[at - 1], now;
    double held_N = 0;
    uint32_t begun = UINT32_MAX;  // of the reaction
    for (uint32_t since = 0; since < kBehind && (begun == UINT32_MAX || since < begun + 12);
         ++since) {
      record::TickInput input = inputs_[at + since];
      g_bad = kGood;
      plan.bend({*controller_, input, inputs_[at], before, since});
      step(input, now);
      if (begun == UINT32_MAX && (now.faults != 0 || (plan.fault == 0 && most != 0))) {
        begun = since;
        held_N = size_of(before.force_N);
        loaded_ += most != 0 && held_N > 0.05;
        if ((now.faults & ~names) != 0) return "another fault is named";
      }
      if (since + 1 == most && begun == UINT32_MAX) return "no fault in time";
      const bool is_cut = plan.reaction == kCut && since == begun;
      const char* problem =
          broken(before, now, is_cut, plan.bend == outrun || plan.fault == servo::kFaultWorkspace);
      if (problem == nullptr && most != 0 && begun != UINT32_MAX)
        problem = wrong(plan, now, since - begun, held_N);
      if (problem != nullptr) return problem;
      before = now;
    }
    return nullptr;
  }
  // `since` ticks after the first of the reaction, with the force before it.
  static const char* wrong(const Plan& plan, const record::TickOutput& now, uint32_t since,
                           double held_N) {
    const double force_N = size_of(now.force_N);
    const bool is_over = plan.reaction == kCut || since >= 9;  // the tenth tick ends at 10 ms
    if (is_over && (force_N > 0 || size_of(now.motor_N) > 0)) return "a force where none may be";
    if (is_over && record::may_push(now)) return "the power stage is on";
    if (plan.fault != 0 && now.faults == 0) return "the fault is gone";
    if (force_N > held_N * (1 + 1e-6)) return "the force grows in its ramp";
    if (plan.reaction == kRamp && since == 0 && force_N < 0.5 * held_N) return "a ramp that cuts";
    return nullptr;
  }
  // What may never be. A hand so fast that energy does not pay for the force lets it fall faster:
  // then `now` is a share of what the slew limit allows.
  const char* broken(const record::TickOutput& was, const record::TickOutput& now, bool is_cut,
                     bool may_fall) const {
    if (!all_finite(now)) return "not finite";
    if (size_of(now.force_N) > kLimit_N * (1 + 1e-6)) return "force above its limit";
    double dot = 0, square = 0, step_N = 0;
    for (int k = 0; k < 3; ++k) dot += wide(now.force_N[k]) * wide(was.force_N[k]);
    for (const float each : now.force_N) square += wide(each) * wide(each);
    const double share = may_fall && dot > square && square > 0 ? square / dot : 1;
    for (int k = 0; k < 3; ++k) {
      const double from = wide(was.motor_N[k]), to = std::fabs(wide(now.motor_N[k]));
      step_N = std::hypot(step_N, wide(now.force_N[k]) / share - wide(was.force_N[k]));
      if (!is_linkage_) continue;
      if (to > kMaxTorque_Nm * (1 + 1e-6)) return "torque above its limit";
      if (to > (from * wide(now.motor_N[k]) > 0 ? std::fabs(from) : 0) + kRise_Nm * (1 + 1e-6))
        return "torque rises too fast";
    }
    if (is_cut || (may_fall && square <= 0)) return nullptr;
    return step_N > kStep_N * (1 + 1e-6) ? "step above the slew limit" : nullptr;
  }

  const Scenario scenario_;
  std::unique_ptr<Tested> controller_;
  std::vector<record::TickInput> inputs_;
  std::vector<record::TickOutput> outputs_;
  uint32_t loaded_ = 0;  // cases that must react, with a force before
  bool is_linkage_ = false;
};

std::vector<Setting> with(const std::vector<Setting>& more) {
  std::vector<Setting> settings = {{params::kSlewLimit, 1000 * static_cast<float>(kStep_N)},
                                   {params::kRampIn, 0.02f},
                                   {params::kWorkspaceHalfX, 0.2f}};
  settings.insert(settings.end(), more.begin(), more.end());
  return settings;
}
void put(record::TickInput& input, double x_m, double y_m, double z_m) {
  const double place_m[3] = {x_m, y_m, z_m};
  for (int k = 0; k < 3; ++k)
    input.encoder_counts[k] = static_cast<int32_t>(std::lround(place_m[k] * 1e5));
}
// 0 to 1 in the ticks between.
double way(uint32_t tick, uint32_t from, uint32_t to) {
  return tick < from ? 0 : tick > to ? 1 : (tick - from) / (1.0 * to - from);
}
// On a ride over the part, lifted.
void ride(record::TickInput& input, double lift_m) {
  static const std::unique_ptr<Ride> ride(new Ride);
  ride->fill(input.tick + 300);
  for (int k = 0; k < 3; ++k) input.encoder_counts[k] = ride->input.encoder_counts[k];
  input.encoder_counts[2] += static_cast<int32_t>(1e5 * lift_m);
}
void wave(record::TickInput& input, const record::TickOutput&) {
  ride(input, 0.002 * std::sin(0.05 * input.tick));
}

}  // namespace

TEST(EveryFault_SlideOnThePart_WithFriction) {
  const auto settings = with({{params::kGuideStiffness, 0.0f}, {params::kFrictionStatic, 0.4f}});
  Matrix({&both(), 300, settings, wave}).run();
}

TEST(EveryFault_TwoRates) { Matrix({&both(), 300, with({}), wave, true}).run(); }

TEST(EveryFault_GuideThatSnapsAndLetsGo) {
  const auto hand = [](record::TickInput& input, const auto&) {
    ride(input, 0.021 - 0.015 * way(input.tick, 20, 120) + 0.015 * way(input.tick, 150, 280));
  };
  Matrix({&both(), 300, with({}), hand}).run();
}

TEST(EveryFault_CornerWhoseStiffnessChanges) {
  static const Asset asset(file_of(mesh_sections(scene_test::two_walls(), "corner")));
  const auto hand = [](record::TickInput& input, const auto&) {
    const double in = way(input.tick, 20, 100);
    put(input, -0.006 + 0.006 * in, 0.0001 * input.tick, 0.006 - 0.006 * in);
    if (input.tick == 120) command(input, params::kContactStiffness, 400);
    if (input.tick == 160) command(input, params::kContactStiffness, 1600);
    if (input.tick == 200) command(input, params::kContactStiffness, 800);
  };
  Matrix({&asset, 250, with({{params::kFrictionStatic, 0.2f}}), hand}).run();
}

TEST(EveryFault_ObjectThatMoves) {
  static const Asset asset(scene_with({{"box", "box", {}, 1e30f, {0, 0, 0.05f}, 0.3f}}));
  const auto hand = [](record::TickInput& input, const auto&) {
    put(input, 0.00005 * input.tick, 0, wide(kHalf_m) + 0.0025);
    const bool begins = input.tick == 60, turns = input.tick == 140, ends = input.tick == 230;
    if (!begins && !turns && !ends) return;
    input.command = record::kCommandMoveObject;
    input.command_value = begins ? 1.0f : turns ? -0.9f : 0.0f;
  };
  Matrix({&asset, 250, with({}), hand}).run();
}

TEST(EveryFault_StartInside_LedOut) {
  static const Asset asset(file_of(box_sections("box")));
  const auto hand = [](record::TickInput& input, const auto&) {
    put(input, 0.002, 0.001, wide(kHalf_m) - 0.001 + 0.003 * way(input.tick, 200, 280));
  };
  Matrix({&asset, 300, with({}), hand}).run();
}

TEST(EveryFault_HotSwapUnderLoad) {
  static const Asset asset(file_of(box_sections("box")));
  static const Asset higher([] {
    std::vector<tools::Section> sections = box_sections("box");
    sections.push_back(tools::origin_section({0, 0, 0.0025}));
    return file_of(std::move(sections));
  }());
  const auto hand = [](record::TickInput& input, const auto&) {
    const double deep_m = 0.003 * way(input.tick, 20, 60);
    put(input, 0.00005 * input.tick, 0, wide(kHalf_m) + 0.0045 - deep_m);
    if (input.tick > 60 && input.tick % 30 == 0) input.command = record::kCommandSwapAsset;
  };
  Matrix({&asset, 250, with({}), hand, false, &higher}).run();
}

// Masses that the motors move between springs; once homed the hand takes them, and presses.
TEST(EveryFault_HomingThenContact) {
  constexpr float kCounts = 20000, kLow_rad[3] = {-0.2f, 0.4f, -1.3f},
                  kHigh_rad[3] = {0.2f, 0.8f, -0.9f};
  device::HomedLinkageLayout layout = {};
  layout.linkage = arm_layout(kCounts, kLow_rad, kHigh_rad);
  layout.homing.by = static_cast<uint32_t>(device::HomeBy::kStops);
  layout.homing.margin_rad = 0.1f;
  layout.homing.speed_rad_per_s = 8;
  for (float& torque_Nm : layout.homing.torque_Nm) torque_Nm = 0.2f;
  std::vector<tools::Section> sections = box_sections("box");
  sections.push_back(tools::make_section(device::kLinkageSection, "arm", &layout, 1));
  const Asset asset(file_of(std::move(sections)));
  float angle_rad[3] = {0.05f, 0.6f, -1.1f}, rate[3] = {};
  const auto hand = [&](record::TickInput& input, const record::TickOutput& last) {
    const bool homes = input.tick <= kEnabled + 1 || !is_homed(last);
    for (int i = 0; i < 60 && homes; ++i) {
      const int k = i % 3;
      const float off_rad =
          std::max(kLow_rad[k] - angle_rad[k], 0.0f) + std::min(kHigh_rad[k] - angle_rad[k], 0.0f);
      const float stop_Nm = 40 * off_rad - (std::fabs(off_rad) > 0 ? 0.2f * rate[k] : 0.0f);
      rate[k] += (last.motor_N[k] + stop_Nm - 0.001f * rate[k]) * 0.05f;
      angle_rad[k] += rate[k] * 5e-5f;
    }
    if (!homes && input.tick < 680) angle_rad[1] -= 0.0002f;
    for (int k = 0; k < 3; ++k)
      input.encoder_counts[k] = static_cast<int32_t>((angle_rad[k] - 3) * kCounts);
  };
  const std::vector<Setting> settings = with({{params::kContactStiffness, 300.0f},
                                              {params::kSceneX, 0.458f},
                                              {params::kSceneY, 0.079f},
                                              {params::kSceneZ, 0.139f}});
  Matrix({&asset, 740, settings, hand}).run();
}

}  // namespace firmtouch::controller_test
