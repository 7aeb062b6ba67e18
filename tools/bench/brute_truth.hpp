#pragma once
#include <functional>
#include <string>
#include <vector>

#include "bench/models.hpp"
#include "surface/point.hpp"

namespace firmtouch::bench {

/// Distance and side by looking at every triangle, in double: no part of the library's method.
struct BruteTruth {
  double distance_m = 0;  // unsigned
  double winding = 0;     // generalized winding number: about 1 inside, 0 outside
};

class BruteForce {
 public:
  explicit BruteForce(const tools::Surface& surface, bool with_winding = true);
  BruteTruth at(tools::Point p) const;

 private:
  struct Triangle {
    tools::Point a, b, c, centre;
    double radius_m;
  };
  std::vector<Triangle> triangles_;
  bool with_winding_;
};

/// Half of the points in 1.5 times the box, the others beside faces, edges and vertices at 1e-7 to
/// 0.1 diagonals, and one in ten up to 1e4 diagonals away.
std::vector<math::Vec3> truth_points(const Model& model, size_t count, uint64_t seed = 1);

/// What the firmware returns for `count` points, warm, against brute force on all threads.
struct TruthReport {
  size_t points = 0;
  double worst_error = 0;  // |returned - truth| over max(diagonal, truth)
  size_t bounds_above_truth = 0;
  size_t not_exact = 0;
  size_t unknown_sides = 0;                // at more than 2e-6 diagonals from the surface
  size_t wrong_sides = 0;                  // among those queried
  std::vector<std::string> wrong_places;   // the first few
  size_t either_side = 0;                  // differ where the surface crosses itself
  std::vector<std::string> either_places;  // the first few
};
TruthReport measure_truth(const Model& model, size_t count,
                          const std::function<void(const std::string&)>& on_progress = {});

}  // namespace firmtouch::bench
