#include "device/symmetric.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace firmtouch::tools {
namespace {

constexpr int kMaxSweeps = 60;

// Turns rows i and j of all, so that square[i][j] becomes 0.
void rotate(Matrix& square, Matrix& way, size_t i, size_t j) {
  const double half = 0.5 * (square[j][j] - square[i][i]) / square[i][j];
  const double t = std::copysign(1, half) / (std::fabs(half) + std::sqrt(half * half + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  for (size_t k = 0; k < square.size(); ++k) {
    const double a = square[k][i], b = square[k][j];
    square[k][i] = c * a - s * b, square[k][j] = s * a + c * b;
  }
  for (size_t k = 0; k < square.size(); ++k) {
    const double a = square[i][k], b = square[j][k];
    square[i][k] = c * a - s * b, square[j][k] = s * a + c * b;
    const double p = way[i][k], q = way[j][k];
    way[i][k] = c * p - s * q, way[j][k] = s * p + c * q;
  }
}

}  // namespace

Directions directions_of(Matrix square) {
  const size_t n = square.size();
  Matrix way(n, std::vector<double>(n));
  for (size_t i = 0; i < n; ++i) way[i][i] = 1;
  for (int sweep = 0; sweep < kMaxSweeps; ++sweep) {
    bool is_diagonal = true;
    for (size_t i = 0; i < n; ++i)
      for (size_t j = i + 1; j < n; ++j) {
        const double size = std::sqrt(std::fabs(square[i][i] * square[j][j]));
        if (std::fabs(square[i][j]) <= 1e-17 * size || !(std::fabs(square[i][j]) > 1e-300))
          continue;
        rotate(square, way, i, j);
        is_diagonal = false;
      }
    if (is_diagonal) break;
  }
  std::vector<size_t> order(n);
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](size_t a, size_t b) { return square[a][a] > square[b][b]; });
  Directions all;
  for (const size_t i : order) all.value.push_back(square[i][i]), all.way.push_back(way[i]);
  return all;
}

}  // namespace firmtouch::tools
