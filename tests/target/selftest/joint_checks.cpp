#include "target/selftest/selftest.hpp"

// Lines, encoders and motors, with a person's help. A motor pushes only while the enable line, and
// no other, is set.
namespace firmtouch::selftest {
namespace {

constexpr int32_t kMoved_counts = 20;
constexpr float kSteps = 1000;  // of a force, to the largest

constexpr char kNoJoint[] = "the board has no such joint";

int32_t g_start[3];

uint32_t joint_count() {
  const uint32_t joints = hal::board_joints();
  return joints < 3 ? joints : 3;
}

void start_counts() {
  for (uint32_t i = 0; i < 3; ++i) g_start[i] = servo.counts[i];
}

int32_t moved(uint32_t joint) {
  if (joint >= joint_count()) return 0;  // what its pins catch
  return static_cast<int32_t>(static_cast<uint32_t>(servo.counts[joint]) -
                              static_cast<uint32_t>(g_start[joint]));
}

bool has_moved(uint32_t joint) {
  return moved(joint) >= kMoved_counts || moved(joint) <= -kMoved_counts;
}

bool any_moved() { return has_moved(0) || has_moved(1) || has_moved(2); }

void set_forces(float x_N, float y_N, float z_N) {
  servo.force_N[0] = x_N;
  servo.force_N[1] = y_N;
  servo.force_N[2] = z_N;
}

void check_line(Prompt what, uint32_t expected, const char* remedy, hal::Wire wire) {
  show(what);
  check("motors_lines", comes([expected] { return servo.lines == expected; }), remedy,
        hal::board_wiring(wire, 0));
}

/// Why encoder or motor `joint` failed; nullptr if it is the only joint that moved.
const char* what_is_wrong(uint32_t joint, const char* none) {
  if (!servo.counts_are_valid) return "the counts became invalid. ";
  if (has_moved((joint + 1) % 3) || has_moved((joint + 2) % 3))
    return "another joint's counts moved: their wires are swapped. ";
  return has_moved(joint) ? nullptr : none;
}

void rest() {
  servo.may_push = false;
  set_forces(0, 0, 0);
  comes(
      [] {
        start_counts();
        wait_ms(100);
        return moved(0) == 0 && moved(1) == 0 && moved(2) == 0;
      },
      3000);
  start_counts();
}

/// Raises the force on `joint` until something moves. Result: the force at which it did; 0 if the
/// motor or the joint is not there, or not as it must be.
float push(uint32_t joint) {
  static const char* const kNames[] = {"motors_write_N, joint 1", "motors_write_N, joint 2",
                                       "motors_write_N, joint 3"};
  if (joint >= joint_count()) {
    skip(kNames[joint], kNoJoint);
    return 0;
  }
  rest();
  servo.may_push = true;
  const float max_N = hal::board_test_force_N(joint);
  float force_N = 0;
  while (!any_moved() && force_N < max_N) {
    force_N += max_N / kSteps;
    servo.force_N[joint] = force_N;
    wait_ms(1);
  }
  const char* wrong = what_is_wrong(joint, "it does not move. ");
  if (wrong == nullptr && moved(joint) < 0)
    wrong = "it moves backwards: swap the motor's wires, or A and B of its encoder. ";
  const bool is_good = check(kNames[joint], wrong == nullptr, wrong == nullptr ? "" : wrong,
                             hal::board_wiring(hal::Wire::kMotor, joint));
  rest();
  return is_good ? force_N : 0;
}

bool stays(const float (&force_N)[3]) {
  start_counts();
  set_forces(force_N[0], force_N[1], force_N[2]);
  wait_ms(200);
  return !any_moved();
}

/// The same forces with the power stage off move nothing.
void check_off(const float (&force_N)[3]) {
  servo.may_push = false;
  wait_ms(2);
  check("motors_state", stays(force_N),
        "motors push though they must not: the power stage stays on");
  rest();
  servo.may_push = true;
  wait_ms(10);
  servo.calls_state = false;
  wait_ms(1);
  hal::motors_off();
  check("motors_off", stays(force_N), "motors push behind it: it must switch the power stage off");
  servo.calls_state = true;
  rest();
}

}  // namespace

void check_lines() {
  using hal::Wire;
  check_line(Prompt::kOpenEnable, 0, "a line is set though none should be. ", Wire::kEnable);
  check_line(Prompt::kCloseEnable, hal::kMotorsEnable, "not the enable line alone is set. ",
             Wire::kEnable);
  check_line(Prompt::kPressStop, hal::kMotorsEnable | hal::kMotorsEmergencyStop,
             "the emergency stop is not seen. ", Wire::kEmergencyStop);
  check_line(Prompt::kReleaseStop, hal::kMotorsEnable, "the emergency stop stays. ",
             Wire::kEmergencyStop);
  check_line(Prompt::kBreakDrive, hal::kMotorsEnable | hal::kMotorsDriveFault,
             "a torn fault wire is not seen. ", Wire::kDriveFault);
  check_line(Prompt::kMendDrive, hal::kMotorsEnable, "the drive's fault stays. ",
             Wire::kDriveFault);
}

void check_encoders() {
  static const char* const kNames[] = {"encoders_read, joint 1", "encoders_read, joint 2",
                                       "encoders_read, joint 3"};
  for (uint32_t joint = 0; joint < 3; ++joint) {
    if (joint >= joint_count()) {
      skip(kNames[joint], kNoJoint);
      continue;
    }
    if (!servo.counts_are_valid) {
      check(kNames[joint], false, "the counts are invalid: power, index, CRC. ",
            hal::board_wiring(hal::Wire::kEncoder, joint));
      continue;
    }
    start_counts();
    show(static_cast<Prompt>(static_cast<uint32_t>(Prompt::kTurnJoint1) + joint));
    comes(any_moved);
    const char* const wrong = what_is_wrong(joint, "no counts come. ");
    check(kNames[joint], wrong == nullptr, wrong == nullptr ? "" : wrong,
          hal::board_wiring(hal::Wire::kEncoder, joint));
    wait_ms(kPatience_ms / 20);  // the hand comes to rest
  }
}

void check_motors() {
  if (!servo.counts_are_valid) return skip("motors_write_N", "the encoders do not work");
  show(Prompt::kLetGo);
  if (!comes([] { return servo.lines == hal::kMotorsEnable; }))
    return void(check("motors_write_N", false, "not checked: not the enable line alone is set"));
  const float force_N[3] = {push(0), push(1), push(2)};
  uint32_t moving = 0;
  for (const float force : force_N) moving += force > 0 ? 1u : 0u;
  if (moving < joint_count())
    skip("motors_state, motors_off", "not for the motors that are not as they must be");
  if (moving > 0) check_off(force_N);
}

}  // namespace firmtouch::selftest
