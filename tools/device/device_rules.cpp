#include "device/device_rules.hpp"

#include <vector>

#include "firmtouch/device/compensation.hpp"
#include "firmtouch/device/derating.hpp"
#include "firmtouch/device/index_pulses.hpp"
#include "firmtouch/device/rules.hpp"
#include "firmtouch/device/second_encoders.hpp"
#include "firmtouch/device/stored_homing.hpp"

namespace firmtouch::tools {
namespace {

// Which key breaks a rule, and what it needs. `element`: of the first of three joints, or any.
// A key that ends in _ is that of the joint.
constexpr uint32_t kAny = ~uint32_t{0};
struct Cause {
  device::Rule rule;
  uint32_t element;
  const char *key, *needs;
};
constexpr Cause kCauses[] = {
    {device::kRuleCountsPerRad, 0, "counts_", "needs 1 to 1e7 counts/rad, with either sign"},
    {device::kRuleAngleRange, 0, "high_", "needs to be above `low_` of its joint"},
    {device::kRuleMaxSpeed, kAny, "max_speed", "needs to be above 0"},
    {device::kRuleOffset, kAny, "base", "needs to be 0 or above: it is the distance of the motors"},
    {device::kRuleNeverCloses, kAny, "linkage",
     "has links that meet at no angles; check the lengths and their units"},
    {device::kRuleMaxTorque, 0, "max_torque_", "needs to be above 0, to 1000 N*m"},
    {device::kRuleFade, kAny, "gone_at",
     "needs 0.001 <= gone_at < full_from <= 1; 0.1 and 0.05 if not given"},
    {device::kRuleHoming, 5, "home",
     "needs each home_torque_, home_margin and home_speed above 0, and home_speed at most "
     "max_speed"},
    {device::kRuleSecondEncoder, 0, "second_", "needs 1 to 1e4 counts/rad, with either sign"},
    {device::kRuleSecondEncoder, 3, "second_within",
     "needs 3 counts of each second encoder and one of the first, and at most 60"},
    {device::kRuleSecondEncoder, 6, "second_within", "needs a `second_` other than 0"},
    {device::kRuleIndex, 1, "index_period_", "needs 240 counts of its joint, or more"},
    {device::kRuleIndex, 4, "index_within", "needs 3 to 60 counts of each joint"},
    {device::kRuleIndex, 7, "index_period_0",
     "and those of the other joints need home_margin or more, and less than the joint's range"},
    {device::kRuleDerating, 0, "continuous_torque_",
     "needs to be above 0, from `home_torque_` to `max_torque_` of its joint"},
    {device::kRuleDerating, 3, "thermal_time_",
     "needs 0.1 s (max_torque_ / continuous_torque_)^2 to 10000 s"},
    {device::kRuleDerating, 6, "continuous_torque_0",
     "or that of another joint needs to be above 0"}};

std::string place(const std::string& name, int line) { return name + ":" + std::to_string(line); }

// In the line of the key, or of the one that stands for it where it is not given.
[[noreturn]] void refuse(const std::string& name, const GivenKeys& given, const std::string& key,
                         const std::string& needs, const std::string& instead = "linkage") {
  const auto line = given.find(key);
  throw Refused(place(name, line != given.end() ? line->second : given.at(instead)) + ": `" + key +
                "` " + needs);
}

void refuse_broken(const std::string& name, const GivenKeys& given, core::Verdict verdict) {
  if (verdict.ok()) return;
  const Cause* cause = nullptr;
  for (const Cause& each : kCauses)
    if (each.rule == verdict.rule && (each.element == kAny || each.element <= verdict.element))
      cause = &each;
  if (cause == nullptr)
    throw Refused(name + ": " + device::rule_name(verdict.rule) + " (element " +
                  std::to_string(verdict.element) + ")");
  std::string key = cause->key;
  if (key.back() == '_') key += std::to_string(verdict.element - cause->element);
  const size_t torque = key.find("_torque_");
  if (torque != std::string::npos && given.count(key) == 0) {
    std::string current = key;
    if (given.count(current.replace(torque, 8, "_current_")) != 0) key = current;
  }
  refuse(name, given, key, cause->needs);
}

// Torque is proportional to current: a current stands for a torque.
void complete_currents(const std::string& name, const GivenKeys& given, LinkageDevice& device) {
  const auto complete = [&](const std::string& end, const std::string& of, float current_A,
                            float Nm_per_A, float& torque_Nm) {
    const std::string current = of + "_current" + end, torque = of + "_torque" + end;
    if (given.count(current) == 0) return;
    if (given.count(torque) != 0)
      refuse(name, given, current, "and `" + torque + "` say the same; leave one of them out");
    if (!(Nm_per_A > 0))
      refuse(name, given, current, "needs `torque_constant" + end + "`, above 0");
    torque_Nm = current_A * Nm_per_A;
  };
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    const std::string end = "_" + std::to_string(k);
    const float Nm_per_A = device.Nm_per_A[k];
    complete(end, "max", device.max_A[k], Nm_per_A, device.limits.max_torque_Nm[k]);
    complete(end, "continuous", device.continuous_A[k], Nm_per_A, device.continuous_Nm[k]);
    if (given.count("torque_constant" + end) != 0 && given.count("max_current" + end) == 0 &&
        given.count("continuous_current" + end) == 0)
      refuse(name, given, "torque_constant" + end, "needs `max_current" + end + "`");
  }
}

void check_rules(const std::string& name, const GivenKeys& given, const LinkageDevice& device) {
  refuse_broken(name, given,
                std::visit([](const auto& l) { return device::check(l); }, device.linkage));
  refuse_broken(name, given, device::check(device.joints));
  refuse_broken(name, given, device::check(device.limits));
  refuse_broken(name, given, device::check(load_of(device)));
}

// What is not given of homing, and words that its way does not use.
void complete_homing(const std::string& name, const GivenKeys& given, LinkageDevice& device) {
  constexpr float kTorqueShare = 0.3f;  // of the largest torque
  const bool is_by_stops = device.homing.by == device::HomeBy::kStops;
  for (const auto& [key, line] : given) {
    const bool is_of_homing = key.rfind("home_", 0) == 0 && key != "home_margin";
    const bool is_of_pose = key.rfind("home_pose", 0) == 0;
    if (!device.is_homed && (is_of_homing || key == "home_margin"))
      throw Refused(place(name, line) + ": `" + key + "` needs `home stops` or `home pose`");
    if (is_of_homing && is_of_pose == is_by_stops)
      throw Refused(place(name, line) + ": `" + key + "` is of `home " +
                    (is_of_pose ? "pose`" : "stops`"));
  }
  if (!device.is_homed) return;
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    const std::string end = "_" + std::to_string(k);
    const device::JointSetting& joint = device.joints.joint[k];
    const float max_Nm = device.limits.max_torque_Nm[k], pose_rad = device.homing.pose_rad[k];
    if (is_by_stops && given.count("home_torque" + end) == 0)
      device.homing.torque_Nm[k] = kTorqueShare * max_Nm;
    if (is_by_stops && !(device.homing.torque_Nm[k] <= max_Nm))
      refuse(name, given, "home_torque" + end, "needs to be at most `max_torque" + end + "`");
    if (!is_by_stops && !(pose_rad >= joint.low_rad && pose_rad <= joint.high_rad))
      refuse(name, given, "home_pose" + end,
             "needs to be from `low" + end + "` to `high" + end + "`; it is 0 if not given",
             "home");
  }
  if (!is_by_stops) device.homing.speed_rad_per_s = 0;
}

// Index pulses need homing by stops and leave no room for second encoders in a tick's input.
void check_index_pulses(const std::string& name, const GivenKeys& given,
                        const LinkageDevice& device) {
  for (const auto& [key, line] : given) {
    if (key.rfind("index_", 0) != 0) continue;
    const std::string at = place(name, line) + ": `" + key + "` needs ";
    if (!device.is_homed || device.homing.by != device::HomeBy::kStops)
      throw Refused(at + "`home stops`");
    if (device.has_second_encoders)
      throw Refused(at + "a device without `second_0`; one of both is compared in a tick");
    for (uint32_t k = 0; k < device.joints.joints; ++k)
      for (const char* const other : {"index", "index_period"})
        if (given.count(other + ("_" + std::to_string(k))) == 0)
          throw Refused(at + "`" + other + ("_" + std::to_string(k)) + "`, too");
    if (given.count("index_within") == 0) throw Refused(at + "`index_within`, too");
  }
}

// Both of a joint, or none.
void check_derating(const std::string& name, const GivenKeys& given, const LinkageDevice& device) {
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    const std::string end = "_" + std::to_string(k);
    const std::string of = given.count("continuous_current" + end) != 0 ? "current" : "torque";
    const std::string torque = "continuous_" + of + end, time = "thermal_time" + end;
    if (given.count(torque) == given.count(time)) continue;
    const bool has_torque = given.count(torque) != 0;
    refuse(name, given, has_torque ? torque : time,
           "needs `" + (has_torque ? time : torque) + "`, too");
  }
}

constexpr double kMinStribeck_rad_per_s = 1e-3;

// Both of a joint, or none.
void check_springs(const std::string& name, const GivenKeys& given, const LinkageDevice& device) {
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    const std::string end = "_" + std::to_string(k), spring = "spring" + end,
                      relaxed = "relaxed" + end;
    if (given.count(spring) == 0 && given.count(relaxed) != 0)
      refuse(name, given, relaxed, "needs `" + spring + "`, the stiffness of the spring");
    if (given.count(spring) == 0) continue;
    if (given.count(relaxed) == 0)
      refuse(name, given, spring, "needs `" + relaxed + "`, the angle at which it has no torque");
    if (!(static_cast<float>(device.masses.joint[k].spring_N_m_per_rad) > 0))
      refuse(name, given, spring, "needs to be above 0");
  }
}

// Between a rotor and the friction behind its cable nothing takes what the torque gives.
void check_carried_friction(const std::string& name, const GivenKeys& given,
                            const LinkageDevice& device) {
  if (!(device.friction_share > 0)) return;
  if (!(device.carried_share > 0))
    refuse(name, given, "friction_share", "needs `carried_share`, within which it is carried");
  bool has_one = false;
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    const JointFriction& joint = device.masses.joint[k];
    const std::string end = "_" + std::to_string(k);
    if (!(static_cast<float>(joint.coulomb_N_m) > 0)) continue;
    has_one = true;
    if (joint.coulomb_N_m > static_cast<double>(device.limits.max_torque_Nm[k]))
      refuse(name, given, "friction_share",
             "needs `coulomb" + end + "` up to `max_torque" + end + "`");
    if (joint.cable_N_m_per_rad > 0)
      refuse(
          name, given, "friction_share",
          "needs a joint without `cable" + end + "`: before a cable it would make the rotor ring");
  }
  if (!has_one)
    refuse(name, given, "friction_share", "needs `coulomb_0`, or that of another joint");
}

// A cable needs a rotor, and one that the simulation's steps of 20 us can follow.
void check_cables(const std::string& name, const GivenKeys& given, const LinkageDevice& device) {
  constexpr double kMaxRate2 = 1e8;  // of cable over rotor: 1.6 kHz
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    const JointFriction& joint = device.masses.joint[k];
    const std::string end = "_" + std::to_string(k);
    if (joint.cable_N_m_per_rad > kMaxRate2 * joint.rotor_kg_m2)
      refuse(name, given, "cable" + end,
             "on `rotor" + end +
                 "` would ring at more than 1.6 kHz; leave the cable out, as it is rigid, or give "
                 "the rotor's inertia");
    for (const char* const key : {"ripple", "cogging"})
      if (given.count(key + end) != 0 && !(joint.poles > 0))
        refuse(name, given, key + end, "needs `poles" + end + "`, its periods in a turn");
    if (joint.backlash_rad > 0 && !(joint.cable_N_m_per_rad > 0))
      refuse(name, given, "backlash" + end, "needs `cable" + end + "`");
  }
}

// Stribeck friction falls from that of rest to Coulomb's.
void check_friction(const std::string& name, const GivenKeys& given, const LinkageDevice& device) {
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    const JointFriction& joint = device.masses.joint[k];
    const std::string end = "_" + std::to_string(k), rest = "breakaway" + end,
                      speed = "stribeck_speed" + end;
    if (given.count(rest) == 0 && given.count(speed) != 0)
      refuse(name, given, speed, "needs `" + rest + "`, the dry friction at rest");
    if (given.count(rest) == 0) continue;
    if (!(joint.breakaway_N_m >= joint.coulomb_N_m))
      refuse(name, given, rest, "needs to be at least `coulomb" + end + "`");
    if (!(joint.stribeck_rad_per_s >= kMinStribeck_rad_per_s))
      refuse(name, given, rest, "needs `" + speed + "`, 0.001 rad/s or above");
  }
}

}  // namespace

core::Verdict check_stored(core::Bytes section) {
  device::StoredLinkage linkage;
  device::StoredHoming homing;
  device::IndexPulses index;
  device::SecondEncoders second;
  device::Derating derating;
  device::Compensation compensation;
  const core::Bytes unsprung = device::Compensation::before(section);
  const core::Bytes cold = device::Derating::before(unsprung);
  const core::Bytes homed = device::IndexPulses::before(cold);
  core::Verdict verdict = open(device::SecondEncoders::before(homed), linkage, homing);
  if (verdict.ok() && homing.is_open()) verdict = index.open(cold, linkage, homing);
  if (verdict.ok()) verdict = second.open(cold, linkage);
  if (verdict.ok()) verdict = derating.open(unsprung, linkage);
  return verdict.ok() ? compensation.open(section, linkage) : verdict;
}

void complete_and_check(const std::string& name, const GivenKeys& given, LinkageDevice& device) {
  complete_currents(name, given, device);
  check_rules(name, given, device);
  complete_homing(name, given, device);
  check_index_pulses(name, given, device);
  if (!device.has_second_encoders && given.count("second_within") != 0)
    refuse(name, given, "second_within",
           "needs `second_0`, the counts of a joint's second encoder");
  check_derating(name, given, device);
  check_springs(name, given, device);
  check_carried_friction(name, given, device);
  if (device.is_homed || device.has_second_encoders || device.is_derated) {
    const std::vector<uint8_t> stored = stored_bytes_of(device);
    refuse_broken(name, given, check_stored({stored.data(), static_cast<uint32_t>(stored.size())}));
  }
  check_cables(name, given, device);
  check_friction(name, given, device);
}

}  // namespace firmtouch::tools
