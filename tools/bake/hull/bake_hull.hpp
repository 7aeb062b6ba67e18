#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "bake/asset/section.hpp"
#include "firmtouch/hull/view.hpp"
#include "firmtouch/mesh/view.hpp"
#include "hull/build_hull.hpp"

namespace firmtouch::tools {

struct HullBakeReport {
  uint32_t faces = 0, collapses = 0;  // of the coarsest hull
  double void_percent = 0;            // of the mesh's volume
  uint32_t star_bytes = 0;            // boxes of stars
  uint32_t box_bytes = 0;             // boxes over the mesh's triangles
  uint32_t base_hull_bytes = 0, other_bytes = 0;
  std::string stalled;  // empty: as coarse as requested; else why not
  std::string problem;  // empty: baked and proven; else what and how to mend it
};

/// The progressive hull of a proven, signed mesh, every new vertex proven outside; read back and
/// proven with the firmware's own Opening. `sections` are the mesh's.
std::vector<Section> bake_hull(const mesh::View& mesh, const std::vector<Section>& sections,
                               const std::string& name, const HullOptions& options,
                               HullBakeReport& report);

}  // namespace firmtouch::tools
