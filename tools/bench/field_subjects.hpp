#pragma once
#include <memory>
#include <string>
#include <vector>

#include "bench/bench.hpp"
#include "field/distance_field.hpp"
#include "surface/surface.hpp"

namespace firmtouch::bench {

/// A closed surface whose distance field is made.
struct Subject {
  std::string name;
  std::unique_ptr<tools::Surface> surface;
  std::vector<tools::Solid> solids;  // one
  bool is_bunny = false;
};

/// The models named, holes closed, or the demo part. Throws a Problem.
std::vector<Subject> field_subjects(const Options& options);
/// The distance field inside and on the surface, on a grid of so many cells along the longest axis.
tools::DistanceField field_of(const Subject& subject, uint32_t cells);
/// Centres of the voxels that the field computed, in the grid's order; `inside_only`: of those
/// inside.
std::vector<tools::Point> centres_of(const tools::DistanceField& distance_field, bool inside_only);

}  // namespace firmtouch::bench
