// The simulated linkage against the same rods as constrained points: positions of their ends,
// constant lengths by Lagrange multipliers, ten times the rate. It knows no joints, no Jacobian and
// no closed loops.
#include "host_sim/device/linkage_body.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "harness/long.hpp"
#include "harness/test.hpp"

#if __has_include(<Eigen/Dense>)
#include <Eigen/Dense>

using namespace firmtouch;  // NOLINT: a test file
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using host_sim::JointMotion;
using host_sim::LinkageBody;
using tools::LinkageDevice;

namespace {

// Ends of rods: a negative number is a fixed point.
struct RodEnds {
  int from, to;
  Vector3d fixed_m;
  tools::Rod rod;
  double length_m;
};

// On a rod from a fixed point: its angle is from `flat` toward `up`.
struct Spring {
  size_t rod;
  double N_m_per_rad, relaxed_rad;
  Vector3d flat, up;
};

// Points with uniform rods between them; `ways` are directions in which no point moves.
struct Points {
  VectorXd at_m, velocity_mps;
  std::vector<RodEnds> rods;
  std::vector<Spring> springs;
  std::vector<std::pair<int, Vector3d>> rails;  // of a point: it moves across this direction only
  bool is_upright = false;                      // point 0 and the tip stay in one plane through z
  double tip_kg = 0;
  int tip = 0;
  Vector3d gravity_mps2;
  MatrixXd mass;
  VectorXd load_N;

  Vector3d end(const VectorXd& of, int i, const Vector3d& fixed) const {
    return i < 0 ? fixed : Vector3d(of.segment<3>(3 * i));
  }

  void prepare() {
    const auto n = at_m.size();
    mass = MatrixXd::Zero(n, n);
    load_N = VectorXd::Zero(n);
    const auto add = [&](int i, int j, double kg) {
      if (i >= 0 && j >= 0) mass.block<3, 3>(3 * i, 3 * j) += kg * Eigen::Matrix3d::Identity();
    };
    for (const RodEnds& r : rods) {
      // Moments of the density over (1 - s)^2, s (1 - s) and s^2.
      const double m = r.rod.mass_kg, l = r.length_m, c = r.rod.centre_m / l;
      const double s2 = (r.rod.inertia_kg_m2 + m * r.rod.centre_m * r.rod.centre_m) / (l * l);
      add(r.from, r.from, m - 2 * m * c + s2);
      add(r.from, r.to, m * c - s2);
      add(r.to, r.from, m * c - s2);
      add(r.to, r.to, s2);
      if (r.from >= 0) load_N.segment<3>(3 * r.from) += m * (1 - c) * gravity_mps2;
      load_N.segment<3>(3 * r.to) += m * c * gravity_mps2;
    }
    add(tip, tip, tip_kg);
    load_N.segment<3>(3 * tip) += tip_kg * gravity_mps2;
  }

  VectorXd acceleration(const VectorXd& at, const VectorXd& velocity,
                        const Vector3d& hand_N) const {
    const auto n = at.size();
    const auto count = static_cast<Eigen::Index>(rods.size() + rails.size()) + (is_upright ? 1 : 0);
    MatrixXd all = MatrixXd::Zero(n + count, n + count);
    VectorXd right = VectorXd::Zero(n + count);
    all.topLeftCorner(n, n) = mass;
    right.head(n) = load_N;
    right.segment<3>(3 * tip) += hand_N;
    for (const Spring& spring : springs) {
      const RodEnds& r = rods[spring.rod];
      const Vector3d way = end(at, r.to, Vector3d::Zero()) - r.fixed_m;
      const double angle_rad = std::atan2(way.dot(spring.up), way.dot(spring.flat));
      const double torque_Nm = spring.N_m_per_rad * (spring.relaxed_rad - angle_rad);
      right.segment<3>(3 * r.to) +=
          torque_Nm / way.norm() *
          (spring.up * std::cos(angle_rad) - spring.flat * std::sin(angle_rad));
    }
    Eigen::Index row = n;
    for (const RodEnds& r : rods) {
      const Vector3d way = end(at, r.to, Vector3d::Zero()) - end(at, r.from, r.fixed_m);
      const Vector3d apart =
          end(velocity, r.to, Vector3d::Zero()) - end(velocity, r.from, Vector3d::Zero());
      all.block<1, 3>(row, 3 * r.to) = way.transpose();
      if (r.from >= 0) all.block<1, 3>(row, 3 * r.from) = -way.transpose();
      right[row++] = -apart.squaredNorm();
    }
    for (const auto& [point, across] : rails)
      all.block<1, 3>(row++, 3 * point) = across.transpose();
    if (is_upright) {  // x0 y1 - y0 x1 = 0
      const int second = 3 * tip;
      all.block<1, 2>(row, 0) << at[second + 1], -at[second];
      all.block<1, 2>(row, second) << -at[1], at[0];
      right[row] = -2 * (velocity[0] * velocity[second + 1] - velocity[1] * velocity[second]);
    }
    all.topRightCorner(n, count) = all.bottomLeftCorner(count, n).transpose();
    return all.partialPivLu().solve(right).head(n);
  }

  void advance(const Vector3d& hand_N, double h) {
    const VectorXd v1 = velocity_mps, a1 = acceleration(at_m, v1, hand_N);
    const VectorXd v2 = v1 + a1 * (h / 2), a2 = acceleration(at_m + v1 * (h / 2), v2, hand_N);
    const VectorXd v3 = v1 + a2 * (h / 2), a3 = acceleration(at_m + v2 * (h / 2), v3, hand_N);
    const VectorXd v4 = v1 + a3 * h, a4 = acceleration(at_m + v3 * h, v4, hand_N);
    at_m += h / 6 * (v1 + 2 * v2 + 2 * v3 + v4);
    velocity_mps += h / 6 * (a1 + 2 * a2 + 2 * a3 + a4);
  }
};

Vector3d to_eigen(host_sim::Vec a) { return {a.x, a.y, a.z}; }

// The points at the beginning are those of the body; all that follows is not.
Points points_of(const LinkageDevice& device, const JointMotion& start, uint32_t elbows) {
  const host_sim::MovingPoints from = host_sim::points_of(device, start);
  Points to;
  to.at_m = to.velocity_mps = VectorXd::Zero(3 * elbows + 3);
  const std::vector<tools::Link> links = tools::links_of(device);
  to.tip = static_cast<int>(elbows);
  for (uint32_t k = 0; k <= elbows; ++k) {
    const host_sim::MovingPoint& point = k < elbows ? from.elbow[k] : from.tip;
    to.at_m.segment<3>(3 * k) = to_eigen(point.at_m);
    to.velocity_mps.segment<3>(3 * k) = to_eigen(point.velocity_mps);
  }
  for (uint32_t k = 0; k < elbows; ++k) {
    const int elbow = static_cast<int>(k);
    to.rods.push_back(
        {-1, elbow, to_eigen(from.base[k].at_m), device.masses.rod[k], links[k].length_m});
    to.rods.push_back(
        {elbow, to.tip, {}, device.masses.rod[elbows + k], links[elbows + k].length_m});
  }
  to.tip_kg = device.masses.tip_mass_kg;
  to.gravity_mps2 = to_eigen(device.masses.gravity_mps2);
  return to;
}

// A quarter of a second of both, with --long `long_s`; the largest distance of the tips over how
// far the tip moved.
double difference(const LinkageDevice& device, const JointMotion& start, Points points,
                  double long_s = 1) {
  points.prepare();
  LinkageBody body(device, start);
  const Vector3d from = points.at_m.segment<3>(3 * points.tip);
  double worst_m = 0, moved_m = 0;
  const double still[3] = {};
  const double end_s = test::is_long() ? long_s : 0.25;
  for (uint32_t step = 0; step * 2e-5 < end_s; ++step) {
    const double t = step * 2e-5;
    const host_sim::Vec hand_N{0.02 * std::sin(11 * t), 0.02 * std::cos(13 * t),
                               0.02 * std::sin(7 * t)};
    body.advance(still, hand_N, 2e-5);
    for (int part = 0; part < 10; ++part) points.advance(to_eigen(hand_N), 2e-6);
    const Vector3d tip = points.at_m.segment<3>(3 * points.tip);
    worst_m = std::max(worst_m, (tip - to_eigen(body.tip().at_m)).norm());
    moved_m = std::max(moved_m, (tip - from).norm());
  }
  CHECK_GE(moved_m, 0.01);
  test::note("1e-12 of the way", static_cast<uint32_t>(worst_m / moved_m * 1e12));
  return worst_m / moved_m;
}

std::string joints(int count) {
  std::string text;
  for (int k = 0; k < count; ++k) {
    const std::string end = "_" + std::to_string(k) + " ";
    text += "counts" + end + "1e6 counts/rad\nlow" + end + "-400 deg\nhigh" + end +
            "400 deg\nmax_torque" + end + "0.5 N*m\n";
  }
  return text;
}

}  // namespace

TEST(Motion_FiveBar_IsThatOfConstrainedPoints) {
  const LinkageDevice device = tools::read_device(
      "five-bar",
      "linkage five_bar\nbase 80 mm\nproximal_0 63 mm\nproximal_1 60 mm\ndistal_0 75 mm\n"
      "distal_1 78 mm\nproximal_mass_0 12 g\nproximal_mass_1 14 g\nproximal_centre_0 20 mm\n"
      "distal_mass_0 9 g\ndistal_mass_1 11 g\ndistal_inertia_1 9e-6 kg*m2\ntip_mass 20 g\n"
      "gravity_y 9.81 m/s2\ngravity_z 0 m/s2\nspring_1 30 mN*m/rad\nrelaxed_1 1 rad\n" +
          joints(2));
  const JointMotion start{{1.8, 1.35}, {0.5, -0.3}};
  Points points = points_of(device, start, 2);
  points.springs = {{2, .03, 1, {1, 0, 0}, {0, 1, 0}}};
  for (int k = 0; k < 3; ++k) points.rails.push_back({k, {0, 0, 1}});
  CHECK_LE(difference(device, start, points), 1e-5);
}

TEST(Motion_Delta_IsThatOfConstrainedPoints) {
  const LinkageDevice device = tools::read_device(
      "delta",
      "linkage delta\nupper_0 60 mm\nupper_1 60 mm\nupper_2 60 mm\nlower_0 103 mm\n"
      "lower_1 103 mm\nlower_2 103 mm\nbase_radius 80 mm\nplatform_radius 21 mm\nside 4.5 mm\n"
      "upper_mass_0 20 g\nupper_mass_1 22 g\nupper_mass_2 18 g\nupper_centre_1 25 mm\n"
      "lower_mass_0 8 g\nlower_mass_1 8 g\nlower_mass_2 9 g\ntip_mass 60 g\ngravity_z 2 m/s2\n"
      "spring_0 20 mN*m/rad\nrelaxed_0 -1 rad\nspring_2 40 mN*m/rad\nrelaxed_2 0.5 rad\n" +
          joints(3));
  const JointMotion start{{1.2, 1.3, 1.1}, {1, -0.5, 0.2}};
  Points points = points_of(device, start, 3);
  for (int k = 0; k < 3; ++k) {  // an upper link stays in its arm's upright plane
    const double turn = 2.0943951023931953 * k;
    points.rails.push_back({k, {-std::sin(turn), std::cos(turn), 0}});
    const Vector3d flat(std::cos(turn), std::sin(turn), 0);
    const size_t rod = static_cast<size_t>(2 * k);
    if (k == 0) points.springs.push_back({rod, .02, -1, flat, {0, 0, 1}});
    if (k == 2) points.springs.push_back({rod, .04, .5, flat, {0, 0, 1}});
  }
  // Then it falls through a place where its loops do not close, and the body stands.
  CHECK_LE(difference(device, start, points, 0.35), 1e-5);
}

// The shoulder is on the axis here, so that two rods in an upright plane are the whole arm.
TEST(Motion_SerialArm_IsThatOfConstrainedPoints) {
  const LinkageDevice device = tools::read_device(
      "arm",
      "linkage serial_arm 3\nlink_0 130 mm\nlink_1 120 mm\nheight 50 mm\nlink_mass_0 50 g\n"
      "link_mass_1 30 g\nlink_centre_0 50 mm\ntip_mass 25 g\n" +
          joints(3));
  const JointMotion start{{0.2, -1.2, -0.6}, {2, 0.5, -0.5}};
  Points points = points_of(device, start, 1);
  points.is_upright = true;
  CHECK_LE(difference(device, start, points), 1e-5);
}

#endif
