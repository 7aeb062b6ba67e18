#pragma once
#include <vector>

#include "firmtouch/mesh/view.hpp"
#include "host_sim/plant/vec.hpp"

namespace firmtouch::host_sim {

/// Distances to a surface over every triangle, in double. An oracle for the controller's answers;
/// shares no code with its search.
class BruteForce {
 public:
  BruteForce() = default;
  explicit BruteForce(const mesh::View& mesh);
  /// Unsigned, of `p_m` (mesh frame). Triangles whose box, or whose block's box, is farther than
  /// the best one are passed over. `nearest`: the triangle to begin with, which makes it fast and
  /// changes no bit; becomes a nearest one.
  double distance_m(Vec p_m, size_t& nearest) const;

 private:
  struct Box {
    Vec low_m, high_m;
  };
  struct Triangle {
    Vec corner_m[3];
    Box box;
  };
  static bool is_farther(const Box& box, Vec p_m, double distance2_m2);

  std::vector<Triangle> triangles_;  // in the order of the tree, so that blocks are compact
  std::vector<Box> blocks_;          // of kBlock triangles each
};

}  // namespace firmtouch::host_sim
