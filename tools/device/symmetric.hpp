#pragma once
#include <vector>

namespace firmtouch::tools {

using Matrix = std::vector<std::vector<double>>;

/// Eigenvalues, the largest first, and unit eigenvectors of a symmetric matrix.
struct Directions {
  std::vector<double> value;
  Matrix way;
};

/// By Jacobi's rotations. Error: 1e-12 of the largest value (host_sim.Calibrate_..._Eigen).
Directions directions_of(Matrix square);

}  // namespace firmtouch::tools
