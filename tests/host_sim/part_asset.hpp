#pragma once
#include <string>

#include "firmtouch/controller/full_controller.hpp"
#include "host_sim/controllers/asset_file.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::test {

/// A temporary folder; removed when the process ends.
const std::string& scratch();

/// Path of a baked asset: the demo's part in 5,000 triangles (`part`) and its guide (`path`).
const std::string& part_asset();

/// Path of the same asset with a second mesh (`lid`) and a second guide (`rim`). The first ones in
/// the table's order are `lid` and `path`.
const std::string& two_part_asset();

/// Scenario for part_asset(): 10,000 ticks of pressing, following the guide and an emergency stop.
host_sim::Scenario loop_scenario();

}  // namespace firmtouch::test
