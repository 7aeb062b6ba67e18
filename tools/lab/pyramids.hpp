#pragma once
#include <vector>

#include "bake/mesh/sign_margin.hpp"
#include "surface/random.hpp"
#include "surface/surface.hpp"

namespace firmtouch::lab {

/// A pyramid of five sides and unit height, whose base stands at random on a circle (Baerentzen &
/// Aanaes 2005, figure 9); apex vertex 0.
struct Pyramid {
  std::vector<tools::Point> base;  // around the origin, in order; the apex is at (0, 0, 1)

  Pyramid(tools::Random& random, double radius);
  /// As an asset holds it.
  tools::Surface surface() const;
};

/// How far the apex's pseudonormal may turn (equation 15 there), below zero where it is wrong.
struct ApexMargins {
  double doubles_rad;  // of double coordinates and sums
  double floats_rad;   // of float32 throughout, angles by the arc cosine
  double stored_rad;   // as baked and decoded, against the float32 pyramid
};
ApexMargins apex_margins(const Pyramid& pyramid);

}  // namespace firmtouch::lab
