#pragma once
#include <cstdint>
#include <vector>

#include "hull/collapse_mesh.hpp"
#include "hull/linear_program.hpp"
#include "hull/progressive_hull.hpp"

namespace firmtouch::tools {

/// What a new vertex must keep.
struct HullLimits {
  uint32_t max_valence = 12;
  double compactness = 0.8;       // least of the faces after, over least of those before
  double max_deviation_deg = 45;  // of each surviving face's normal, 0 to 90
  /// Rounds to float32 without offset or proof, as a hull must not: shows that the tests of
  /// enclosure can fail.
  bool is_careless = false;
};

/// Why an edge may not collapse, counted.
struct HullCounts {
  uint64_t programs = 0;    // linear programs solved
  uint64_t unsolvable = 0;  // of them without a solution
  uint64_t on_box = 0;      // of them with one only far away
  uint64_t link = 0, valence = 0, compactness = 0, deviation = 0;
  uint64_t off_grid = 0;
  uint64_t not_outside = 0;  // refused by the exact check
  uint64_t evaluations = 0;  // edges looked at, in all
  uint64_t comparisons = 0;  // of keys in the queue
};

/// Where a collapsed edge's new vertex goes: outside every face around the edge, with the least
/// volume between, by linear programming; on the grid, so offset by half a cell; proven there in
/// exact arithmetic; then the tests of shape.
class Placement {
 public:
  Placement(const CollapseMesh& mesh, const HullGrid& grid, const HullLimits& limits,
            HullCounts& counts);

  /// Link condition and valence; fills star().
  bool may_collapse(uint32_t edge);
  const Star& star() const { return star_; }
  /// Of the star that may_collapse() found. Result: false where no vertex will do.
  bool place(math::Vec3& at_m, double& volume_m3);
  /// The paper's second priority: the volume that the star spans with the middle of its link.
  double centre_volume_m3() const;

 private:
  bool solve(Point& x_m);
  bool is_outside(math::Vec3 at_m) const;
  bool keeps_shape(Point at_m);
  Point at(uint32_t vertex) const { return to_point(mesh_.vertices()[vertex]); }

  const CollapseMesh& mesh_;
  const HullGrid& grid_;
  const HullLimits limits_;
  const double min_cosine_;
  HullCounts& counts_;
  LinearProgram program_;
  std::vector<HalfSpace> spaces_;
  Star star_;
};

}  // namespace firmtouch::tools
