#include "bake/tree/principal_axes.hpp"

#include <array>

namespace firmtouch::tools {
namespace {

using Matrix = std::array<std::array<double, 3>, 3>;

// Makes m[p][q] zero by a rotation of the two axes.
void rotate(Matrix& m, Matrix& axes, size_t p, size_t q) {
  if (!(m[p][q] > 0 || m[p][q] < 0)) return;
  const double theta = (m[q][q] - m[p][p]) / (2 * m[p][q]);
  const double t = (theta < 0 ? -1 : 1) / (std::fabs(theta) + std::sqrt(theta * theta + 1));
  const double c = 1 / std::sqrt(t * t + 1), s = t * c;
  for (size_t k = 0; k < 3; ++k) {
    const double a = m[k][p], b = m[k][q];
    m[k][p] = c * a - s * b;
    m[k][q] = s * a + c * b;
  }
  for (size_t k = 0; k < 3; ++k) {
    const double a = m[p][k], b = m[q][k];
    m[p][k] = c * a - s * b;
    m[q][k] = s * a + c * b;
  }
  for (size_t k = 0; k < 3; ++k) {
    const double a = axes[k][p], b = axes[k][q];
    axes[k][p] = c * a - s * b;
    axes[k][q] = s * a + c * b;
  }
}

}  // namespace

Frame principal_axes(const std::vector<Point>& points) {
  Point mean{};
  for (const Point& p : points) mean = mean + p * (1.0 / static_cast<double>(points.size()));
  Matrix m{}, axes{};
  for (size_t k = 0; k < 3; ++k) axes[k][k] = 1;
  for (const Point& p : points) {
    const double d[3] = {p.x - mean.x, p.y - mean.y, p.z - mean.z};
    for (size_t i = 0; i < 3; ++i)
      for (size_t j = 0; j < 3; ++j) m[i][j] += d[i] * d[j];
  }
  for (int sweep = 0; sweep < 12; ++sweep) {
    rotate(m, axes, 0, 1);
    rotate(m, axes, 0, 2);
    rotate(m, axes, 1, 2);
  }
  std::array<size_t, 3> order{0, 1, 2};
  for (size_t i = 0; i < 2; ++i)
    for (size_t j = 0; j < 2 - i; ++j)
      if (m[order[j]][order[j]] < m[order[j + 1]][order[j + 1]]) std::swap(order[j], order[j + 1]);
  Frame frame;
  for (size_t i = 0; i < 2; ++i) {
    const size_t k = order[i];
    frame.axis[i] = {axes[0][k], axes[1][k], axes[2][k]};
  }
  frame.axis[0] = frame.axis[0] * (1 / length(frame.axis[0]));
  frame.axis[1] = frame.axis[1] - frame.axis[0] * dot(frame.axis[0], frame.axis[1]);
  frame.axis[1] = frame.axis[1] * (1 / length(frame.axis[1]));
  frame.axis[2] = cross(frame.axis[0], frame.axis[1]);
  return frame;
}

}  // namespace firmtouch::tools
