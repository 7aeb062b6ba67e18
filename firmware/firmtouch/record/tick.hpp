#pragma once
#include <stddef.h>
#include <stdint.h>

// What one tick takes and gives, as plain values: the controller computes the second from its state and the first, the
// record keeps both, replay compares them bit for bit. Little-endian, no padding.

namespace firmtouch::record {

constexpr uint32_t kAxes = 3;

// Lines of TickInput::lines.
constexpr uint32_t kLineEnable = 1u << 0;         // the operator's enable; falling: ramp out, motors off
constexpr uint32_t kLineEmergencyStop = 1u << 1;  // latched fault
constexpr uint32_t kLineDriveFault = 1u << 2;     // the motor driver reports a fault: latched fault
constexpr uint32_t kLineEncoderFault = 1u << 3;   // a count of this tick is not to be trusted

/// Everything that a tick depends on besides the controller's state. Nothing else may be read in a tick.
struct TickInput {
  uint32_t tick;                   // number of this tick, from 0
  uint32_t clock_us;               // free-running, wraps
  int32_t encoder_counts[kAxes];
  uint32_t lines;
  uint32_t command;                // 0: none; else 1 + the parameter's index: set it to command_value at this tick
  float command_value;
};
static_assert(sizeof(TickInput) == 32);

struct TickOutput {
  float motor_N[kAxes];            // force (torque) of each joint's motor; joint frame
  float position_m[kAxes];         // tool, device frame
  float velocity_mps[kAxes];
  float force_N[kAxes];            // at the tool, after every limit
  float distance_m;                // signed distance of the tool's centre to the nearest surface
  float distance_lower_m;          // its certified lower bound (unsigned)
  float penetration_m;             // of the tool's sphere; 0 in free space
  float guide_deviation_m;         // distance to the guide; 0 where there is none
  float guide_arc;                 // 0 to 1 along the guide
  uint32_t steps;                  // all tree nodes read in this tick
  uint32_t faults;                 // latched, one bit a fault (servo/fault.hpp)
  uint32_t state;                  // bits 0-7: servo state; 8: contact; 9: on guide; 10: exact; 16-17: sign + 1
  uint32_t model_sequence;         // of the local model that this tick used
};
static_assert(sizeof(TickOutput) == 84);

struct TickRecord {
  TickInput input;
  TickOutput output;
};
static_assert(sizeof(TickRecord) == 116);

}  // namespace firmtouch::record
