#pragma once
#include <string>
#include <variant>
#include <vector>

#include "device/refused.hpp"
#include "firmtouch/core/span.hpp"
#include "firmtouch/device/delta.hpp"
#include "firmtouch/device/five_bar.hpp"
#include "firmtouch/device/homing.hpp"
#include "firmtouch/device/layout.hpp"
#include "firmtouch/device/load.hpp"
#include "firmtouch/device/serial_arm.hpp"
#include "surface/point.hpp"

namespace firmtouch::tools {

/// A link that moves like a rod: its mass lies on the line between its ends.
struct Rod {
  double mass_kg = 0;
  double centre_m = 0;       // of mass, from the end nearer to the base
  double inertia_kg_m2 = 0;  // about the centre of mass, across the rod
};

/// What resists a joint's motion, what balances it, and the cable or belt between its motor and it.
struct JointFriction {
  double rotor_kg_m2 = 0;                         // of motor and transmission, at the joint
  double cable_N_m_per_rad = 0, cable_N_m_s = 0;  // stiffness, 0 is rigid; damping
  double backlash_rad = 0;                        // the whole gap
  double viscous_N_m_s = 0;
  double coulomb_N_m = 0;
  double breakaway_N_m = 0, stribeck_rad_per_s = 0;  // dry friction at rest, and by which rate
                                                     // a 1 / e of what it is more is left
  double lag_s = 0;                                  // of the amplifier, first order
  double ripple = 0, cogging_N_m = 0;  // share of the torque, and beside it: amplitudes
  double poles = 0;                    // periods of both in a turn of the joint
  double noise_counts = 0;             // of its encoder: standard deviation
  double winding_rise_K = 80;          // of its motor at the continuous torque
  double magnet_rise_K = 0, magnet_time_s = 300;
  double spring_N_m_per_rad = 0, relaxed_rad = 0;  // that balances weight: 0 is none; no torque
};

/// What the simulator needs, and the compensation of weight.
struct MassModel {
  // As the lengths: five-bar proximal 0, 1, distal 0, 1; serial arm 0, 1; delta upper, lower.
  Rod rod[6];
  double tip_mass_kg = 0;
  JointFriction joint[device::kMaxJoints];
  Point gravity_mps2{0, 0, -9.80665};  // linkage's frame
  double stop_N_m_per_rad = 30;        // end stops of the ranges
  double stop_N_m_s = 0.01;
};

/// A linkage with its joints, limits and masses.
struct LinkageDevice {
  std::variant<device::FiveBar, device::SerialArm, device::Delta> linkage;
  device::JointSettings joints;
  device::TorqueLimits limits;
  float torque_rise_s = 0.002f;
  float carried_share = 0;
  float friction_share = 0;  // of the joints' Coulomb friction that the motors carry
  float friction_fade_rad_per_s = 0.05f;
  MassModel masses;
  bool are_walls_forced = false;  // motors come on beside walls that are not stable
  bool is_homed = false;          // its encoders count from where they are switched on
  device::HomingSettings homing;
  bool has_index_pulses = false;     // on joints; in `homing`, whose `by` is then kStops
  bool has_second_encoders = false;  // on joints, compared with the first
  float second_counts_per_rad[device::kMaxJoints] = {};  // 0: the joint has none
  float second_within_rad = 0;                           // by which they may differ from the first
  bool is_derated = false;                               // motors have thermal limits
  float continuous_Nm[device::kMaxJoints] = {}, thermal_time_s[device::kMaxJoints] = {};
  // Currents that stand for torques, and what turns them into those at the joint; 0: not given.
  float max_A[device::kMaxJoints] = {}, continuous_A[device::kMaxJoints] = {};
  float Nm_per_A[device::kMaxJoints] = {};
};

/// Reads a device file: a statement a line, `KEY VALUE UNIT`; # begins a comment.
///     linkage five_bar                first; or serial_arm, delta
///     base 25 mm                      the linkage's lengths, as in its header
///     proximal_0 63 mm
///     ...
///     counts_0 13824 counts/turn      of each joint: encoder, range and largest torque
///     low_0 60 deg
///     high_0 150 deg
///     max_torque_0 0.3 N*m            or max_current_0 2 A with torque_constant_0 0.15 N*m/A
///     walls forced                    optional: motors come on beside walls that are not stable
///     home stops                      optional, or `home pose`: also home_torque_0 (default: 0.3
///     of
///                                     max_torque_0), home_speed, home_margin, home_pose_0
///     index_0 30 deg                  optional, of each joint: also index_period_0, index_within
///     continuous_torque_0 90 mN*m     optional, of each joint, with thermal_time_0 5 s;
///                                     or continuous_current_0 0.6 A
///     spring_0 50 mN*m/rad            optional, of each joint, with relaxed_0 90 deg
///     friction_share 0.7              optional, of coulomb_0, with carried_share
///     proximal_mass_0 20 g            optional, of each link: also proximal_centre_0 (default: the
///                                     middle), proximal_inertia_0 (default: of an even rod)
/// `name` stands before the line in messages.
/// Throws Refused: an unknown, missing or doubled key, a wrong unit, a value out of range, or a
/// rule of firmtouch/device/rules.hpp.
LinkageDevice read_device(const std::string& name, const std::string& text);

/// All keys with their units, for --help.
std::string device_file_help();

/// A link of a device file: `name`_`number`.
struct Link {
  const char* name;
  int number;
  double length_m;
};
/// In the order of MassModel::rod; the first half are driven by the joints, each by its own.
std::vector<Link> links_of(const LinkageDevice& device);

/// Where the weight of the links acts.
device::Load load_of(const LinkageDevice& device);

/// The motors carry weight that springs balance in part, or a share of friction.
bool has_compensation(const LinkageDevice& device);

/// The section that the firmware reads: the linkage, with its homing, index pulses or second
/// encoders, thermal limits, springs and friction, if any.
std::vector<uint8_t> stored_bytes_of(const LinkageDevice& device);
/// Its first part.
device::LinkageLayout layout_of(const LinkageDevice& device);
/// Of a whole section: the rule that it breaks.
core::Verdict check_stored(core::Bytes section);

}  // namespace firmtouch::tools
