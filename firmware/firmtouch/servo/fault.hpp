#pragma once
#include <stdint.h>

// What switches the motors off. Numbered, append-only, latched: one bit each in
// record::TickOutput::faults, until a clear command while the enable line is low. The parameter
// that governs a fault stands behind it.
namespace firmtouch::servo {

constexpr uint32_t kFaultNotFinite = 1u << 0;      // position, velocity or force
constexpr uint32_t kFaultModel = 1u << 1;          // a local model with NaN or out of range
constexpr uint32_t kFaultStaleModel = 1u << 2;     // model_age
constexpr uint32_t kFaultDeadline = 1u << 3;       // late_ratio, tick_period_s (clock_watch.hpp)
constexpr uint32_t kFaultClock = 1u << 4;          // jumped, stood, other rate; tick_period_s
constexpr uint32_t kFaultEncoder = 1u << 5;        // lost, or faster than max_speed_mps
constexpr uint32_t kFaultWorkspace = 1u << 6;      // outside of workspace_half_{x,y,z}_m
constexpr uint32_t kFaultDrive = 1u << 7;          // the motor driver's line
constexpr uint32_t kFaultEmergencyStop = 1u << 8;  // the operator's line
constexpr uint32_t kFaultAsset = 1u << 9;          // enabled with a rejected asset
constexpr uint32_t kFaultProbes = 1u << 10;        // enabled with other arithmetic than the baker's
constexpr uint32_t kFaultSettings = 1u << 11;      // servo settings out of range
constexpr uint32_t kFaultGuard = 1u << 12;         // the guard stopped a force
// Ticks take 0.9 of tick_period_s or more: the main loop would stand still (clock_watch.hpp). While
// it is latched, no tick queries the geometry.
constexpr uint32_t kFaultOverload = 1u << 13;
// For 10 ms, or for 0.2 s before the motors come on, the work budget did not suffice to certify the
// proxy; or a tool that began inside did not come out in 10 s.
constexpr uint32_t kFaultContact = 1u << 14;
// For 10 ms contact has given the hand 1 mJ more than energy_reservoir_J.
constexpr uint32_t kFaultEnergy = 1u << 15;
// Objects that move left the proxy less than 0.9 of its radius (scene/objects.hpp).
constexpr uint32_t kFaultSqueezed = 1u << 16;
// The linkage was not homed; the record says what failed (record/tick.hpp).
constexpr uint32_t kFaultHoming = 1u << 17;
constexpr uint32_t kFaultCount = 18;

// These cut the force in the same tick. The others ramp it down over kRampOut_s, because a sudden
// loss of support hits the hand; force_limit_N holds meanwhile.
constexpr uint32_t kCutAtOnce = kFaultNotFinite | kFaultModel | kFaultDrive | kFaultEmergencyStop |
                                kFaultAsset | kFaultProbes | kFaultSettings | kFaultGuard;
// These are latched only while the motors are on: plugging in an encoder or halting in a debugger
// with the motors off does no harm. A cause that is present while they are enabled and wait for a
// certain model is latched then, and the motors stay off.
constexpr uint32_t kOnlyWhileOn = kFaultStaleModel | kFaultDeadline | kFaultClock | kFaultEncoder |
                                  kFaultWorkspace | kFaultContact | kFaultEnergy | kFaultSqueezed;

/// Short name of fault `number` (its bit), for messages and tables.
/// Result: "unknown" beyond the last.
constexpr const char* fault_name(uint32_t number) {
  constexpr const char* kName[kFaultCount] = {
      "not finite", "model",    "stale model",       "deadline", "clock",    "encoder",
      "workspace",  "drive",    "emergency stop",    "asset",    "probes",   "settings",
      "guard",      "overload", "contact uncertain", "energy",   "squeezed", "homing"};
  return number < kFaultCount ? kName[number] : "unknown";
}

/// Cause of fault `number` and the parameter that governs it: one line for a person, short enough
/// for link::Description.
/// Result: empty beyond the last.
constexpr const char* fault_text(uint32_t number) {
  constexpr const char* kText[kFaultCount] = {
      "input or force not finite",
      "local model out of range",
      "no local model in time (model_age)",
      "late ticks (late_ratio, tick_period_s)",
      "clock jumped, or early ticks (tick_period_s)",
      "encoder lost, or beyond max_speed_mps",
      "tool left workspace_half_{x,y,z}_m",
      "the drive reported a fault",
      "emergency stop pressed",
      "refused asset: bake it again",
      "probe answers have other bits here",
      "servo setting out of range",
      "guard stopped a force (force_limit_N)",
      "ticks over 0.9 tick_period_s: lower budgets",
      "raise tick_work, bake a hull, start outside",
      "gave energy: lower contact_stiffness (energy_reservoir_J)",
      "objects squeeze: keep them apart",
      "not homed: free joints, clear, enable"};
  return number < kFaultCount ? kText[number] : "";
}

}  // namespace firmtouch::servo
