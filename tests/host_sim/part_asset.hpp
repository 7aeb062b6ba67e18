#pragma once
#include <memory>
#include <string>

#include "firmtouch/controller/full_controller.hpp"
#include "host_sim/controllers/asset_file.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::test {

/// A folder of this process's own, gone when it ends.
const std::string& scratch();

/// The demo's part in 5,000 triangles and its path, baked into scratch(): the asset's path.
const std::string& part_asset();

/// The closed loop of the tests over that asset: 10,000 ticks of pressing, following and an
/// emergency stop.
host_sim::Scenario loop_scenario();

}  // namespace firmtouch::test
