#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "bake/asset/section.hpp"
#include "firmtouch/field/view.hpp"

namespace firmtouch::tools {

struct FieldReport {
  uint32_t count[3] = {0, 0, 0};
  uint32_t bytes = 0;
  double cell_m = 0, quantum_m = 0;
  uint32_t unknown = 0;  // cells that say nothing
  std::string problem;   // empty: baked and proven; else what and how to mend it
};

/// The distance field of a proven mesh: `long_axis` cells along its longest side and one more on
/// every side, each from a query of the firmware; proven with the firmware's Opening.
std::vector<Section> bake_field(const mesh::View& mesh, const std::string& name, uint32_t long_axis,
                                FieldReport& report);

}  // namespace firmtouch::tools
