#pragma once
#include <stdint.h>

// Input and output of one tick as plain structs. The controller computes the output from its state
// and the input; the record keeps both; replay compares them bit for bit. Little-endian, no
// padding.

namespace firmtouch::record {

constexpr uint32_t kAxes = 3;

// Bits of TickInput::flags (the field is called `lines` in logs and CSV).
constexpr uint32_t kFlagEnable = 1u << 0;  // the operator's enable; falling: ramp out, motors off
constexpr uint32_t kFlagEmergencyStop = 1u << 1;  // latched fault
constexpr uint32_t kFlagDriveFault = 1u << 2;     // the motor driver reports a fault: latched fault
constexpr uint32_t kFlagEncoderFault = 1u << 3;   // a count of this tick is invalid
// The local model, if geometry and servo run at two rates (controller.hpp).
constexpr uint32_t kFlagModelApart = 1u << 4;   // this tick does not compute the local model
constexpr uint32_t kFlagModelTaken = 1u << 5;   // this tick starts to use the finished model
constexpr uint32_t kFlagModelWanted = 1u << 6;  // the next model is made from this tick's position
// From this bit on a byte each: the low bytes of the counts of the joints' second encoders, or
// index pulses. 0 where the program uses neither (controller/redundant_device.hpp,
// indexed_device.hpp).
constexpr uint32_t kFlagSecondCountsShift = 8;

// TickInput::command. A value out of range, or a parameter that may not change while the motors are
// on, is rejected: the parameter keeps its value, and kStateCommandRefused is set.
constexpr uint32_t kCommandNone = 0;
constexpr uint32_t kCommandClearFaults = UINT32_MAX;  // accepted only while kFlagEnable is low
// Begins to touch the next asset, if the controller has one (controller.hpp, can_swap()).
constexpr uint32_t kCommandSwapAsset = UINT32_MAX - 1;
// Plus the number of an object, at most 15: it moves by its twist times command_value, -1 to 1
// (controller/mesh_objects.hpp). Rejected at two rates.
constexpr uint32_t kCommandMoveObject = UINT32_MAX - 0xFF;
// Plus an axis, 0 to 2: component of the rotation vector to which the handle of a tool is turned,
// in radians (controller/mesh_tool.hpp). Rejected at two rates.
constexpr uint32_t kCommandTurnTool = UINT32_MAX - 0x1FF;

// TickOutput::state.
constexpr uint32_t kStateServoMask = 0xFFu;          // servo::Mode
constexpr uint32_t kStateContact = 1u << 8;          // the tool's sphere penetrates the surface
constexpr uint32_t kStateOnGuide = 1u << 9;          // the guide holds the tool
constexpr uint32_t kStateExact = 1u << 10;           // the mesh query was exact
constexpr uint32_t kStateCommandTaken = 1u << 11;    // this tick's command took effect
constexpr uint32_t kStateCommandRefused = 1u << 12;  // this tick's command was rejected
constexpr uint32_t kStateReady = 1u << 13;           // an asset is open and proven
constexpr uint32_t kStateGuideExact = 1u << 14;      // the guide query was exact
constexpr uint32_t kStateOfBaseHull = 1u << 15;  // the base hull was rendered instead of the mesh
// Two bits: sign of the distance + 1. 1: unknown; then only the base hull makes a force.
constexpr uint32_t kStateSignShift = 16;
// Contact is through a proxy; distance and its bound are the proxy's. 0: penalty contact.
constexpr uint32_t kStateProxy = 1u << 18;
constexpr uint32_t kStateUncertain = 1u << 19;  // the visits did not certify the proxy
// The linkage is not homed (controller/homed_device.hpp): no force is rendered. While kStateHoming
// the motors home it. What failed: four bits device::HomingFault, two its joint, two the other one.
constexpr uint32_t kStateNotHomed = 1u << 20;
constexpr uint32_t kStateHoming = 1u << 21;
constexpr uint32_t kStateHomingFaultShift = 22;
// Where it is homed, five bits: 1 + number of the object that holds the proxy, or of the sphere
// with the least room; 0: none, or there is one surface and one sphere.
constexpr uint32_t kStateObjectShift = 22;
// There where the asset has materials and no objects, eight bits: 1 + number of the material that
// the tool touches; 0: none. It touches where kStateContact is set.
constexpr uint32_t kStateMaterialShift = 22;
// The operator enables beside a wall that is stiffer than what is stable on the linkage
// (controller/any_device.hpp): the motors stay off, or the device file forced it.
constexpr uint32_t kStateWallRefused = 1u << 30;
constexpr uint32_t kStateWallForced = 1u << 31;

/// Everything that a tick depends on, except the controller's state.
struct TickInput {
  uint32_t tick;      // number of this tick, from 0
  uint32_t clock_us;  // free-running, wraps
  int32_t encoder_counts[kAxes];
  uint32_t flags;
  // kCommandNone, kCommandClearFaults, kCommandSwapAsset, kCommandMoveObject + object,
  // kCommandTurnTool + axis, or 1 + index of the parameter to set to command_value.
  uint32_t command;
  float command_value;
  // Time that the tick before took, by the board's clock; divided by tick_period_s, the load. 0:
  // not measured, as in lock-step.
  uint32_t last_work_us;
};
static_assert(sizeof(TickInput) == 36);

struct TickOutput {
  float motor_N[kAxes];     // force (torque) of each joint's motor; joint frame
  float position_m[kAxes];  // tool, device frame
  float velocity_mps[kAxes];
  float force_N[kAxes];     // at the tool, after every limit
  float distance_m;         // signed distance of the proxy, or the tool's centre, to the surface
  float distance_lower_m;   // its certified lower bound (unsigned)
  float penetration_m;      // hand to proxy, or depth of the tool's sphere; 0 in free space
  float guide_deviation_m;  // distance to the guide; 0 without a guide
  float guide_lower_m;      // certified lower bound of that distance
  float guide_arc;          // 0 to 1 along the guide
  uint32_t steps;           // visits: tree nodes read in this tick by all queries
  uint32_t guide_steps;     // of these, by the guide query
  uint32_t faults;          // latched; one bit per fault (servo/fault.hpp)
  uint32_t state;           // kState... above
  uint32_t model_sequence;  // of the local model that this tick used
  float proxy_m[kAxes];     // of contact, at the end of the tick; without one the tool
  float torque_Nm[kAxes];   // of contact on the handle of a tool of spheres, before every limit
};
static_assert(sizeof(TickOutput) == 116);

/// The flags that carry these low bytes of second counts.
constexpr uint32_t flags_of_second(const uint8_t (&counts)[kAxes]) {
  uint32_t flags = 0;
  for (uint32_t k = 0; k < kAxes; ++k)
    flags |= uint32_t{counts[k]} << (kFlagSecondCountsShift + 8 * k);
  return flags;
}

/// The flags that carry index pulses since the tick before. Bit k of `pulses`: joint k passed one;
/// `latched`: low bytes of its counts there, of which seven bits are carried.
constexpr uint32_t flags_of_index(uint32_t pulses, const uint8_t (&latched)[kAxes]) {
  uint32_t flags = 0;
  for (uint32_t k = 0; k < kAxes; ++k)
    if ((pulses >> k & 1u) != 0) flags |= (latched[k] | 0x80u) << (kFlagSecondCountsShift + 8 * k);
  return flags;
}

/// The state of a tick, where that of its device is known: while it is not homed, homing's bits are
/// not mixed with the object of a model that was made before.
constexpr uint32_t without_old_object(uint32_t state, uint32_t of_device) {
  if ((of_device & kStateNotHomed) == 0) return state;
  constexpr uint32_t kOfDevice = ~(kStateNotHomed - 1);
  return (state & ~kOfDevice) | (of_device & kOfDevice);
}

/// Whether the power stage may be on: the servo pushes, its force still falls to zero, or the
/// motors home the linkage.
constexpr bool may_push(const TickOutput& output) {
  const uint32_t mode = output.state & kStateServoMask;
  return mode == 1 || mode == 2 || mode == 3 ||  // of servo::Mode; controller_core.cpp checks it
         (output.state & kStateHoming) != 0;
}

/// Whether the motors hold the joints, so that their brake may be released: the force has grown in,
/// or the motors home the linkage.
constexpr bool may_move(const TickOutput& output) {
  return (output.state & kStateServoMask) == 2 || (output.state & kStateHoming) != 0;
}

struct TickRecord {
  TickInput input;
  TickOutput output;
};
static_assert(sizeof(TickRecord) == 152);

}  // namespace firmtouch::record
