#pragma once
#include <map>
#include <string>

#include "device/device_file.hpp"

namespace firmtouch::tools {

/// The keys of a device file, and the line of each.
using GivenKeys = std::map<std::string, int>;

/// Fills in what a file leaves out of homing, and checks what no single line can: firmware rules,
/// keys that need others, cables. Throws Refused, with the line of the key.
void complete_and_check(const std::string& name, const GivenKeys& given, LinkageDevice& device);

}  // namespace firmtouch::tools
