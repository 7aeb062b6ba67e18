#pragma once
#include <string>
#include <vector>

#include "host_sim/device/linkage_body.hpp"
#include "host_sim/report/scene3d.hpp"

namespace firmtouch::host_sim {

/// Condition of a linkage in a plane of its workspace, across z.
struct ConditionMap {
  Vec low_m, high_m;  // corners
  uint32_t columns = 0, rows = 0;
  // Reciprocal condition in the middle of each cell, from the highest y down; below 0: out of
  // reach.
  std::vector<double> reciprocal;

  Vec middle_m(uint32_t column, uint32_t row) const;
};
ConditionMap condition_map(const LinkageDevice& device, double z_m);

/// A card of the report: the map at the height of the largest force, and the way of the tool.
std::string condition_card(const LinkageDevice& device, const RunPaths& run);

}  // namespace firmtouch::host_sim
