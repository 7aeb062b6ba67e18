// The axes of oriented boxes, checked against the eigenvectors of another library.
#include "bake/tree/principal_axes.hpp"

#include <cmath>

#include "harness/test.hpp"
#include "surface/random.hpp"

#if __has_include(<Eigen/Eigenvalues>)
#include <Eigen/Eigenvalues>

namespace firmtouch::tools {
namespace {

Eigen::Vector3d wide(Point p) { return {p.x, p.y, p.z}; }

// Points within a box of these sides, turned at random, far from the origin.
std::vector<Point> cloud(Random& random, Point sides) {
  const auto any = [&] { return random.between(-1, 1); };
  const Eigen::Matrix3d turn = Eigen::Quaterniond(any(), any(), any(), 1.5).normalized().matrix();
  std::vector<Point> points;
  const uint32_t count = 3 + random.below(200);
  for (uint32_t i = 0; i < count; ++i) {
    const Eigen::Vector3d at =
        turn * Eigen::Vector3d(any() * sides.x, any() * sides.y, any() * sides.z);
    points.push_back({at.x() + 7, at.y() - 3, at.z() + 1});
  }
  return points;
}

void check_axes(const std::vector<Point>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Point& p : points) mean += wide(p) / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Point& p : points) spread += (wide(p) - mean) * (wide(p) - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> truth(spread);
  const double slack = 1e-9 * spread.trace() + 1e-25;
  const Frame frame = principal_axes(points);
  Eigen::Matrix3d axes;
  for (int k = 0; k < 3; ++k) axes.col(k) = wide(frame.axis[k]);
  CHECK_LE((axes.transpose() * axes - Eigen::Matrix3d::Identity()).norm(), 1e-12);
  CHECK_LE(std::fabs(axes.determinant() - 1), 1e-12);
  const Eigen::Matrix3d seen = axes.transpose() * spread * axes;
  for (int k = 0; k < 3; ++k) {
    CHECK_LE(std::fabs(seen(k, k) - truth.eigenvalues()(2 - k)), slack);
    CHECK_LE(std::fabs(seen(k, (k + 1) % 3)), slack);
  }
}

}  // namespace
#else
namespace firmtouch::tools {
namespace {

std::vector<Point> cloud(Random&, Point) { return {}; }
void check_axes(const std::vector<Point>&) { test::skip("Eigen is missing"); }

}  // namespace
#endif

TEST(PrincipalAxes_AreTheEigenvectors_WidestFirst) {
  Random random(11);
  for (int i = 0; i < 3000; ++i) {
    test::note("cloud", i);
    check_axes(cloud(random, {random.between(0.1, 2), random.between(0.1, 2), 1}));
  }
}

TEST(PrincipalAxes_FlatThinOrEqualClouds_StayAFrame) {
  Random random(12);
  const Point sides[] = {{1, 1, 0}, {1, 0, 0}, {0, 0, 1}, {1, 1e-6, 1e-9}, {1, 1, 1}, {0, 0, 0}};
  for (const Point& size : sides)
    for (int i = 0; i < 200; ++i) check_axes(cloud(random, size));
}

}  // namespace firmtouch::tools
