#include "target/selftest/selftest.hpp"

#include "emulator/exit.hpp"

// Joints and a person that follows the prompts, simulated; and a defect in each function of the
// HAL. tests/target/run_selftest has the list: number, function, what the report must say.
namespace firmtouch {
namespace {

// Read before anything is broken. NUL, or none: nothing is. The next byte is how many joints the
// device lacks.
uint32_t defect() {
  static const uint8_t number = hal::board_asset().data()[0];
  return number;
}
bool has(uint32_t number) { return defect() == number; }
uint32_t joint_count() {
  static const uint8_t lacking = hal::board_asset().data()[1];
  return 3u - lacking;
}

// Joints of 0.1 kg with dry friction, in counts of 10 um.
struct Joint {
  float position, velocity, force_N;
};
Joint g_joints[3];
bool g_has_power = false;
uint32_t g_lines = 0;
int32_t g_turned = -1;  // the joint that the person turns

void move(Joint& joint, float force_N) {
  constexpr float kTick_s = 1e-3f, kMass_kg = 0.1f, kFriction_N = 0.3f, kCounts_per_m = 1e5f;
  const float drive_N = force_N > 0 ? force_N - kFriction_N : force_N + kFriction_N;
  if (force_N > kFriction_N || force_N < -kFriction_N) {
    joint.velocity += drive_N / kMass_kg * kTick_s;
  } else {
    joint.velocity = 0;
  }
  joint.position += joint.velocity * kTick_s * kCounts_per_m;
}

using selftest::Prompt;

// What the person does to the motors' lines.
struct Act {
  Prompt at;
  uint32_t sets, clears;
};
constexpr Act kActs[] = {{Prompt::kCloseEnable, hal::kMotorsEnable, 0},
                         {Prompt::kLetGo, hal::kMotorsEnable, 0},
                         {Prompt::kPressStop, hal::kMotorsEmergencyStop, 0},
                         {Prompt::kReleaseStop, 0, hal::kMotorsEmergencyStop},
                         {Prompt::kBreakDrive, hal::kMotorsDriveFault, 0},
                         {Prompt::kMendDrive, 0, hal::kMotorsDriveFault}};

void follow(const char* text) {
  const auto is = [&](Prompt at) { return text == selftest::kPrompts[static_cast<uint32_t>(at)]; };
  for (const Act& act : kActs)
    if (is(act.at)) g_lines = (g_lines | act.sets) & ~act.clears;
  if (is(Prompt::kTurnJoint1)) g_turned = 0;
  if (is(Prompt::kTurnJoint2)) g_turned = 1;
  if (is(Prompt::kTurnJoint3)) g_turned = 2;
}

}  // namespace

// The board's joints.
namespace hal {

bool encoders_read(int32_t (&counts)[3]) {
  for (int32_t i = 0; i < 3; ++i) {
    move(g_joints[i], g_has_power ? g_joints[i].force_N : 0);
    if (i == g_turned) g_joints[i].position += 1;
    const bool is_there = static_cast<uint32_t>(i) < joint_count();
    counts[i] = is_there ? static_cast<int32_t>(g_joints[i].position) : 0;
  }
  if (g_turned >= 0 && counts[g_turned] % 64 == 63) g_turned = -1;
  return true;
}
void motors_write_N(const float (&motor_N)[3]) {
  for (uint32_t i = 0; i < 3; ++i) g_joints[i].force_N = motor_N[i];
}
void motors_state(bool may_push) { g_has_power = may_push; }
void motors_off() { g_has_power = false; }
uint32_t motors_lines() { return g_lines; }
uint32_t board_joints() { return joint_count(); }
// Less than their friction, or enough.
float board_test_force_N(uint32_t) { return has(41) ? 0.2f : 2.0f; }
void emulator_exit(int) { board_print(g_has_power ? "end, power: 1\n" : "end, power: 0\n"); }

}  // namespace hal

namespace planted {
namespace {

template <class T>
void swap(T& a, T& b) {
  const T kept = a;
  a = b;
  b = kept;
}

}  // namespace

void board_begin() {
  if (!has(1)) hal::board_begin();
}
const char* board_name() { return has(2) ? "" : hal::board_name(); }
core::Bytes board_asset() {
  const core::Bytes asset = hal::board_asset();
  return has(3) ? core::Bytes{asset.data() + 4, asset.size() - 4} : asset;
}
void board_print(const char* text) {
  follow(text);
  if (!has(4)) hal::board_print(text);
}
void board_exit(int status) {
  if (!has(5)) hal::board_exit(status);
  for (;;) asm volatile("nop");
}
bool board_may_exit() { return has(6); }
uint32_t board_stack_high_bytes() { return has(7) ? 512 : hal::board_stack_high_bytes(); }

uint32_t clock_us() {
  const uint32_t us = hal::clock_us();
  if (has(8)) return us & 0xFFFF;
  if (has(9)) return us & 0x3FFFFF;
  return has(10) ? 5 : us;
}
uint32_t clock_work() { return has(11) ? 5 : hal::clock_work(); }
uint32_t clock_work_per_1000() { return hal::clock_work_per_1000() * (has(12) ? 10 : 1); }
void clock_start_servo(uint32_t period_us, void (*tick)()) {
  static uint32_t calls = 0;
  if (has(13)) return;
  if (has(14) && ++calls > 1) return;
  hal::clock_start_servo(has(15) ? period_us * 9 / 8 : period_us, tick);
}

bool encoders_read(int32_t (&counts)[3]) {
  const bool is_good = hal::encoders_read(counts);
  if (has(16)) swap(counts[0], counts[1]);
  if (has(17)) counts[2] = 7;
  return is_good && !has(18);
}

uint32_t link_read(uint8_t* to, uint32_t capacity) {
  return has(19) ? 0 : hal::link_read(to, capacity);
}
uint32_t link_write(const uint8_t* from, uint32_t count) {
  if (has(20)) return count;
  if (!has(21)) return hal::link_write(from, count);
  const uint8_t wrong = static_cast<uint8_t>(*from | 0x80);
  return hal::link_write(&wrong, 1);
}
void link_wait() {
  for (uint32_t from_us = hal::clock_us(); has(22) || (has(23) && clock_us() - from_us < 5000);) {
  }
}

void motors_state(bool may_push) { hal::motors_state(may_push || has(24)); }
void motors_write_N(const float (&motor_N)[3]) {
  float force_N[3] = {motor_N[0], motor_N[1], motor_N[2]};
  if (has(25)) force_N[1] = -force_N[1];
  if (has(26)) force_N[2] = 0;
  if (has(27)) swap(force_N[0], force_N[1]);
  hal::motors_write_N(force_N);
}
void motors_off() {
  if (!has(28)) hal::motors_off();
}
uint32_t motors_lines() {
  const uint32_t lines = hal::motors_lines();
  if (has(29)) return lines & ~kMotorsEmergencyStop;
  if (has(30)) return lines & ~kMotorsDriveFault;
  return has(31) ? lines ^ kMotorsEnable : lines;
}

ParameterFlash board_parameters() {
  ParameterFlash flash = hal::board_parameters();
  if (has(32)) flash.sector[0] = flash.sector[1];
  return flash;
}
bool board_erase_parameters(uint32_t sector) {
  return has(33) || hal::board_erase_parameters(sector);
}
bool board_program_parameters(uint32_t sector, uint32_t offset, core::Bytes bytes) {
  if (has(34)) offset += 32;
  return hal::board_program_parameters(sector, offset, bytes);
}

#ifdef FIRMTOUCH_ASSET_SLOTS
AssetSlots board_asset_slots() {
  AssetSlots slots = hal::board_asset_slots();
  if (has(35)) slots.slot[0] = {slots.slot[0].data(), slots.slot[0].size() / 2};
  return slots;
}
bool board_erase_asset(uint32_t slot, uint32_t offset) {
  return has(36) || hal::board_erase_asset(slot, offset);
}
bool board_program_asset(uint32_t slot, uint32_t offset, core::Bytes bytes) {
  return !has(37) && hal::board_program_asset(slot, offset, bytes);
}
#endif

void watchdog_begin(uint32_t timeout_us) {
  if (!has(38)) hal::watchdog_begin(has(39) ? timeout_us / 10 : timeout_us);
}
void watchdog_feed() {
  if (!has(40)) hal::watchdog_feed();
}

}  // namespace planted
}  // namespace firmtouch
