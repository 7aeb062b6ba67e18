#pragma once
#include <string>
#include <variant>

#include "firmtouch/device/delta.hpp"
#include "firmtouch/device/five_bar.hpp"
#include "firmtouch/device/serial_arm.hpp"

namespace firmtouch::host_sim {

/// A linkage with its joints and torque limits.
struct LinkageDevice {
  std::variant<device::FiveBar, device::SerialArm, device::Delta> linkage;
  device::JointSettings joints;
  device::TorqueLimits limits;
};

/// Reads a device file: a statement a line, `KEY VALUE UNIT`; # begins a comment.
///     linkage five_bar                first; or serial_arm, delta
///     base 25 mm                      the linkage's lengths, as in its header
///     proximal_0 63 mm
///     ...
///     counts_0 13824 counts/turn      of each joint: encoder, range and largest torque
///     low_0 60 deg
///     high_0 150 deg
///     max_torque_0 0.3 N*m
/// `name` stands before the line in messages.
/// Throws Refused: an unknown, missing or doubled key, a wrong unit, a value out of range, or a
/// rule of firmtouch/device/rules.hpp.
LinkageDevice read_device(const std::string& name, const std::string& text);

}  // namespace firmtouch::host_sim
