#pragma once
#include <cstdint>
#include <utility>
#include <vector>

#include "bake/asset/probes.hpp"
#include "bake/hull/bake_hull.hpp"
#include "harness/test.hpp"

namespace firmtouch::hull_test {

/// Bakes a hull of the mesh `part` on the 16-bit grid and adds its sections to the mesh's.
inline void add_hull(std::vector<tools::Section>& sections, uint32_t faces) {
  mesh::View view;
  CHECK(tools::open_baked(sections, "part", view).ok());
  tools::HullOptions options;
  options.target_faces = faces;
  options.grid_bits = 16;
  tools::HullBakeReport report;
  for (tools::Section& section : tools::bake_hull(view, sections, "part", options, report))
    sections.push_back(std::move(section));
  CHECK(report.problem.empty());
}

}  // namespace firmtouch::hull_test
