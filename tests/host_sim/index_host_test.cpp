// Simulated machines that are homed by index pulses: sound ones are never off, also fast, behind
// cables with backlash; a belt that slips is found at the first pulse that the simulation gives.
#include <cmath>
#include <sstream>

#include "bench/models.hpp"
#include "device/machines.hpp"
#include "harness/long.hpp"
#include "harness/test.hpp"
#include "host_sim/bench/rig.hpp"

namespace {

using namespace firmtouch;            // NOLINT: a test file
using namespace firmtouch::host_sim;  // NOLINT

constexpr double kPeriod_deg = 9, kWithin_deg = 0.3;

// A machine's file with index pulses; the first joint's are behind a cable with backlash.
std::string indexed(const std::string& machine, const bench::TemporaryFolder& folder) {
  const std::string text = tools::read_device_text(machine);
  const tools::LinkageDevice device = tools::read_device(machine, text);
  const double rotor_kg_m2 = device.masses.joint[0].rotor_kg_m2;
  std::ostringstream file;
  file << text << "\nhome stops\nstop_damping 0.2 N*m*s/rad\nindex_within " << kWithin_deg
       << " deg\n";
  for (uint32_t k = 0; k < device.joints.joints; ++k)
    file << "index_" << k << " " << 1.7 + 2.2 * k << " deg\nindex_period_" << k << " "
         << kPeriod_deg << " deg\n";
  // A rotor of 1 g cm2 does not come to rest behind its cable at a stop: homing fails.
  if (rotor_kg_m2 > 2e-6)
    file << "cable_0 " << 1e7 * rotor_kg_m2 << " N*m/rad\ncable_damping_0 " << 3e2 * rotor_kg_m2
         << " N*m*s/rad\nbacklash_0 0.06 deg\n";
  return folder.write(machine, file.str());
}

// A hand that moves about in the air.
struct Machinery {
  bench::TemporaryFolder folder;
  std::string file;
  tools::LinkageDevice device;
  Rig rig;
  Session session;
  Scenario scenario;

  Machinery(const std::string& machine, uint32_t rounds)
      : file(indexed(machine, folder)),
        device(tools::read_device(file, tools::read_device_text(file))),
        rig(3, file),
        session(rig.bake(plate(0.02))),
        scenario(rig.scenario({0, 0, 0.03}, script(rounds), {{"ramp_in", "0.03 s"}})) {}

  static std::vector<std::string> script(uint32_t rounds) {
    std::vector<std::string> all = {Rig::hold_s(0.05)};
    const double speeds_mps[] = {0.05, 0.3, 0.9};
    for (uint32_t i = 0; i < rounds; ++i) {
      const double speed_mps = speeds_mps[i % 3], x = i % 2 == 0 ? 0.014 : -0.014;
      all.push_back(Rig::to({x, 0, 0.032}, speed_mps));
      all.push_back(Rig::to({x, -x, 0.03}, speed_mps));
      all.push_back(Rig::to({-x, -x, 0.034}, speed_mps));
    }
    return all;
  }
};

// Result: bit k: a pulse of joint k is in this tick's input.
uint32_t pulses_in(const record::TickInput& input) {
  uint32_t pulses = 0;
  for (uint32_t k = 0; k < record::kAxes; ++k)
    pulses |= (input.flags >> (record::kFlagSecondCountsShift + 8 * k + 7) & 1u) << k;
  return pulses;
}

bool is_homed(const record::TickOutput& output) {
  return (output.state & record::kStateNotHomed) == 0;
}

struct Sound {
  uint32_t ticks = 0, homed_at = 0, pulses = 0, faults = 0;
};
Sound run_sound(Machinery& machine) {
  Sound sound;
  machine.session.controller->reset();
  const Environment environment;
  Simulation simulation(machine.scenario, machine.session.tick(), environment);
  for (RunTick now; simulation.next(now); ++sound.ticks) {
    sound.faults |= now.record.output.faults;
    if (!is_homed(now.record.output)) continue;
    if (sound.homed_at == 0) sound.homed_at = sound.ticks;
    sound.pulses += pulses_in(now.record.input) != 0 ? 1u : 0u;
  }
  return sound;
}

void check_slip(Machinery& machine, uint32_t joint, uint32_t tick, uint32_t& found) {
  Scenario scenario = machine.scenario;
  Event event;
  event.kind = Event::Kind::kFail;
  event.time_s = tick * 1e-3;
  event.failure = {FailureMode::kEncoderSlipped, joint};
  scenario.events.push_back(event);
  machine.session.controller->reset();
  const Environment environment;
  Simulation simulation(scenario, machine.session.tick(), environment);
  uint32_t faults = 0, since = 0;
  for (RunTick now; simulation.next(now) && since < 12;) {
    const record::TickInput& input = now.record.input;
    faults = now.record.output.faults;
    if (input.tick < tick) CHECK_EQ(faults, 0u);
    // In the tick of the failure a pulse may have been before it.
    if (input.tick > tick && (pulses_in(input) >> joint & 1u) != 0) CHECK(faults != 0);
    if (faults == 0) continue;
    CHECK_EQ(faults, servo::kFaultEncoder);
    double sum_Nm = 0;
    for (const float torque_Nm : now.record.output.motor_N)
      sum_Nm += std::fabs(static_cast<double>(torque_Nm));
    if (++since > 10) CHECK_LE(sum_Nm, 0.0);
  }
  found += faults != 0 ? 1 : 0;
}

const char* const kMachines[] = {"haply_pantograph", "pantograph_mk2",     "falcon_like",
                                 "omega_like",       "phantom_premium_15", "touch_like"};

}  // namespace

TEST(IndexPulses_SoundMachines_AreNoFault) {
  const uint32_t rounds = test::is_long() ? 3000 : 8;
  for (const char* const name : kMachines) {
    Machinery machine(name, rounds);
    const Sound sound = run_sound(machine);
    test::note(name, sound.ticks);
    test::note("ticks with pulses", sound.pulses);
    CHECK_EQ(sound.faults, 0u);
    CHECK(sound.homed_at > 0);
    CHECK_GE(sound.pulses, 2 * rounds);
  }
}

TEST(IndexPulses_MachinesWhoseBeltSlips_AreAFaultAtTheNextPulse) {
  const uint32_t every = test::is_long() ? 97 : 1700;
  for (const char* const name : kMachines) {
    Machinery machine(name, 8);
    const Sound sound = run_sound(machine);
    uint32_t found = 0, runs = 0;
    for (uint32_t tick = sound.homed_at + 1100; tick + 600 < sound.ticks; tick += every)
      for (uint32_t joint = 0; joint < machine.device.joints.joints; ++joint, ++runs)
        check_slip(machine, joint, tick, found);
    test::note(name, runs);
    CHECK_EQ(found, runs);
    CHECK_GE(runs, 4u);
  }
}
