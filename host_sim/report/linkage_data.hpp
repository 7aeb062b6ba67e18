#pragma once
#include <string>

#include "host_sim/device/linkage_body.hpp"

namespace firmtouch::host_sim {

/// A linkage as JSON for the live page (pages/linkage.js), which draws its links.
std::string linkage_data_of(const LinkageDevice& device);

}  // namespace firmtouch::host_sim
