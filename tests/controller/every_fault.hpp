#pragma once
// The causes of all faults that inputs, commands, memory and a user's own parts can bring about,
// and what SAFETY.md says of each.
#include "controller/placed.hpp"
#include "firmtouch/controller/tool_controller.hpp"

namespace firmtouch::controller_test {

// What a user's own parts do in the tick that comes: a shape or guide, and a device.
enum Bad { kGood, kNaN, kUncertain, kSqueezed, kVelocity };
inline Bad g_bad = kGood;
struct BadGuide : Guides<CurveGuide, SplineGuide> {
  void follow(const ModelRequest& request, const params::Values& values, ModelResult& result) {
    Guides::follow(request, values, result);
    if (g_bad == kUncertain) result.model.is_uncertain = true;
    if (g_bad == kSqueezed) result.model.is_squeezed = true;
    if (g_bad == kNaN) result.model.plane_count = 1, result.model.plane[0].offset_m = NAN;
  }
};
struct BadDevice : EveryDevice {
  device::Reading read(const params::Values& values, const device::Sample& sample, bool clear) {
    device::Reading reading = EveryDevice::read(values, sample, clear);
    if (g_bad == kVelocity) reading.velocity_mps.y = 2 * servo::kMaxVelocity_mps;
    return reading;
  }
};
using Tested =
    Controller<SurfacesWithTool<FullMaterialMesh>, BadGuide, BadDevice, asset::Proven, TwoScenes>;

struct Now {
  Tested& controller;
  record::TickInput& input;
  const record::TickInput& first;  // before it was bad
  const record::TickOutput& last;
  uint32_t since;  // ticks since then
};
inline void command(record::TickInput& input, uint32_t row, float value) {
  input.command = 1 + row;
  input.command_value = value;
}
inline void spoil_model(const Now&) { g_bad = kNaN; }
inline void be_uncertain(const Now&) { g_bad = kUncertain; }
inline void squeeze(const Now&) { g_bad = kSqueezed; }
inline void once(const Now& now, uint32_t flags) { now.input.flags |= now.since == 0 ? flags : 0; }
inline void lose(const Now& now) { now.input.flags |= record::kFlagEncoderFault; }
inline void leap(const Now& now) {
  now.input.encoder_counts[1] += now.since % 2 == 0 ? 200000 : -200000;
}
inline void make_no_model(const Now& now) {
  now.input.flags &= ~(record::kFlagModelTaken | record::kFlagModelWanted);
  now.input.flags |= record::kFlagModelApart;
}
inline void outrun(const Now& now) {  // leaps along the force, and returns
  for (int k = 0; k < 3 && now.since % 2 == 1; ++k)
    if (std::fabs(now.last.force_N[k]) > 0.1f)
      now.input.encoder_counts[k] += now.last.force_N[k] > 0 ? 300 : -300;
}
inline void trip_guard(const Now& now) {
  unsigned char* bytes = reinterpret_cast<unsigned char*>(&now.controller);
  for (size_t at = 0; at + 4 <= sizeof(Tested) && now.since == 0; at += 4) {
    uint32_t word = 0;
    std::memcpy(&word, bytes + at, 4);
    if (word == servo::kGuardArmed) bytes[at] ^= 4u;
  }
}
inline void load(const Now& now, core::Bytes asset) {
  now.input.command = 0;  // it would swap back
  if (now.since == 0) (void)now.controller.open(asset);
}
inline core::Bytes nonsense() {
  alignas(16) static const uint8_t bytes[64] = {};
  return bytes;
}
inline core::Bytes other_arithmetic() {
  static const Asset made([] {
    std::vector<tools::Section> sections = box_sections("box");
    for (tools::Section& section : sections)
      if (section.type == mesh::kProbesSection) section.bytes[8] ^= 1;  // the hash
    return file_of(std::move(sections));
  }());
  return made.bytes();
}

enum Reaction { kCut, kRamp, kNone };  // kNone: the fault need not come, and limits hold
struct Plan {
  const char* name;
  uint32_t fault, within_ticks;
  Reaction reaction;
  void (*bend)(const Now& now);
};
inline const Plan kPlans[] = {
    {"NaN", servo::kFaultModel, 1, kCut, spoil_model},
    {"uncertain", servo::kFaultContact, 10, kRamp, be_uncertain},
    {"squeezed", servo::kFaultSqueezed, 1, kRamp, squeeze},
    {"too fast", servo::kFaultNotFinite, 1, kCut,
     [](const Now& n) { g_bad = n.since == 0 ? kVelocity : kGood; }},
    {"no model", servo::kFaultStaleModel, 4, kRamp, make_no_model},
    {"late", servo::kFaultDeadline, 3, kRamp,
     [](const Now& n) { n.input.clock_us += 1000 * (n.since + 1); }},
    {"stall", servo::kFaultDeadline, 1, kRamp, [](const Now& n) { n.input.clock_us += 5000; }},
    {"clock set back", servo::kFaultClock, 1, kRamp,
     [](const Now& n) { n.input.clock_us -= 50000; }},
    {"clock stands", servo::kFaultClock, 4, kRamp,
     [](const Now& n) { n.input.clock_us -= 1000 * n.since; }},
    {"clock's rate", servo::kFaultClock, 33, kRamp,
     [](const Now& n) { n.input.clock_us -= 300 * n.since; }},
    {"encoder lost", servo::kFaultEncoder, 3, kRamp, lose},
    {"encoder leaps", servo::kFaultEncoder, 3, kRamp, leap},
    {"fifths lost", servo::kFaultEncoder, 26, kRamp,
     [](const Now& n) { return n.since % 5 == 0 ? lose(n) : void(); }},
    {"out of reach", servo::kFaultWorkspace, 90, kRamp,
     [](const Now& n) { n.input.encoder_counts[0] += 450 * static_cast<int32_t>(n.since); }},
    {"drive", servo::kFaultDrive, 1, kCut, [](const Now& n) { once(n, record::kFlagDriveFault); }},
    {"stop", servo::kFaultEmergencyStop, 1, kCut,
     [](const Now& n) { once(n, record::kFlagEmergencyStop); }},
    {"rejected asset", servo::kFaultAsset, 1, kCut, [](const Now& n) { load(n, nonsense()); }},
    {"probes", servo::kFaultProbes, 1, kCut, [](const Now& n) { load(n, other_arithmetic()); }},
    {"setting", servo::kFaultSettings, 1, kCut,
     [](const Now& n) {
       const_cast<float&>(n.controller.values().value[params::kSlewLimit]) = NAN;
     }},
    {"guard", servo::kFaultGuard, 1, kCut, trip_guard},
    {"overload", servo::kFaultOverload, 3, kRamp, [](const Now& n) { n.input.last_work_us = 950; }},
    {"hand outruns", servo::kFaultEnergy, 14, kRamp, outrun},
    {"watchdog", 0, 1, kCut,
     [](const Now& n) { return n.since == 0 ? n.controller.reset() : void(); }},
    {"disabled", 0, 1, kRamp, [](const Now& n) { n.input.flags &= ~record::kFlagEnable; }},
    {"one visit", servo::kFaultContact, 0, kNone,
     [](const Now& n) { return n.since == 0 ? command(n.input, params::kMeshWork, 1) : void(); }},
    {"encoder stands", 0, 0, kNone,
     [](const Now& n) { n.input.encoder_counts[2] = n.first.encoder_counts[2]; }},
};

}  // namespace firmtouch::controller_test
