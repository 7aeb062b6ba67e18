// Linkages against kinematics in double: loops closed by Newton's method, arms by a product of
// rotations, inverse kinematics in closed form, Jacobians by central differences.
#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "firmtouch/device/delta.hpp"
#include "firmtouch/device/five_bar.hpp"
#include "firmtouch/device/serial_arm.hpp"
#include "harness/long.hpp"
#include "harness/random.hpp"
#include "harness/test.hpp"

using namespace firmtouch;  // NOLINT: a test file
using device::Delta;
using device::FiveBar;
using device::Pose;
using device::SerialArm;

#if __has_include(<Eigen/Dense>)
#include <Eigen/Dense>

using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace {

constexpr double kPi = 3.14159265358979323846;
using Angles = Vector3d;

double wide(float a) { return static_cast<double>(a); }
Vector3d wide(math::Vec3 a) { return {wide(a.x), wide(a.y), wide(a.z)}; }

/// What an oracle must give of a linkage.
struct Truth {
  uint32_t joints;
  double shortest_m;  // of the driven links
  // The tip; `start_m` is near it.
  std::function<Vector3d(const Angles&, const Vector3d& start_m)> tip_m;
  // All angles of a joint that put the tip there, given the other joints' angles.
  std::function<std::vector<double>(uint32_t joint, const Vector3d& tip_m, const Angles&)> inverse;
  // Volume that unit vectors along the rods span (planar: with z): 0 where the loop is singular.
  std::function<double(const Vector3d& tip_m, const Angles&)> rods_volume;
  // True where the tip is on the linkage's side of its elbows.
  std::function<bool(const Vector3d& tip_m, const Angles&)> is_on_branch;
};

// The tip at a given distance from each of `count` points that turn with their joints.
struct Rods {
  uint32_t count;
  std::function<Vector3d(uint32_t, double)> end_m;
  double length_m[3];

  double volume(const Vector3d& tip_m, const Angles& at) const {
    Matrix3d rows = Matrix3d::Identity();
    for (uint32_t k = 0; k < count; ++k)
      rows.row(k) = (tip_m - end_m(k, at[k])).normalized().transpose();
    return std::fabs(rows.determinant());
  }

  Vector3d close(const Angles& at, Vector3d tip_m) const {
    for (int step = 0; step < 8; ++step) {
      Matrix3d rows = Matrix3d::Zero();
      Vector3d off(0, 0, 0);
      rows(2, 2) = 1;  // a planar linkage stays in z = 0
      off(2) = tip_m.z();
      for (uint32_t k = 0; k < count; ++k) {
        const Vector3d rod = tip_m - end_m(k, at[k]);
        rows.row(k) = 2 * rod.transpose();
        off[k] = rod.squaredNorm() - length_m[k] * length_m[k];
      }
      tip_m -= rows.fullPivLu().solve(off);
    }
    return tip_m;
  }
};

// Angles t where a + b cos t + c sin t = 0.
std::vector<double> roots(double a, double b, double c) {
  const double size = std::hypot(b, c), middle = std::atan2(c, b);
  if (std::fabs(a) > size) return {middle + (a > 0 ? kPi : 0)};
  const double spread = std::acos(-a / size);
  return {middle + spread, middle - spread};
}

Truth truth_of(const FiveBar& bar) {
  const auto motor_m = [=](uint32_t k) {
    return Vector3d((k == 0 ? -0.5 : 0.5) * wide(bar.base_m), 0, 0);
  };
  const auto end_m = [=](uint32_t k, double t) -> Vector3d {
    return motor_m(k) + wide(bar.proximal_m[k]) * Vector3d(std::cos(t), std::sin(t), 0);
  };
  const Rods rods{2, end_m, {wide(bar.distal_m[0]), wide(bar.distal_m[1]), 0}};
  return {2,
          wide(std::min(bar.proximal_m[0], bar.proximal_m[1])),
          [=](const Angles& at, const Vector3d& start_m) { return rods.close(at, start_m); },
          [=](uint32_t k, const Vector3d& tip_m, const Angles&) {
            const Vector3d w = tip_m - motor_m(k);
            const double a = wide(bar.proximal_m[k]), b = wide(bar.distal_m[k]);
            return roots(w.squaredNorm() + a * a - b * b, -2 * a * w.x(), -2 * a * w.y());
          },
          [=](const Vector3d& tip_m, const Angles& at) { return rods.volume(tip_m, at); },
          [=](const Vector3d& tip_m, const Angles& at) {
            const Vector3d first = end_m(0, at[0]), way = end_m(1, at[1]) - first;
            return (way.cross(tip_m - first).z() > 0) == bar.is_tip_left;
          }};
}

Truth truth_of(const Delta& delta) {
  const auto turn = [](uint32_t k) { return AngleAxisd(2 * kPi * k / 3, Vector3d::UnitZ()); };
  const Vector3d offset_m(wide(delta.base_radius_m) - wide(delta.platform_radius_m),
                          wide(delta.side_m), 0);
  const auto end_m = [=](uint32_t k, double t) -> Vector3d {
    return turn(k) * (offset_m + wide(delta.upper_m[k]) * Vector3d(std::cos(t), 0, std::sin(t)));
  };
  const Rods rods{
      3, end_m, {wide(delta.lower_m[0]), wide(delta.lower_m[1]), wide(delta.lower_m[2])}};
  return {3,
          wide(*std::min_element(delta.upper_m, delta.upper_m + 3)),
          [=](const Angles& at, const Vector3d& start_m) { return rods.close(at, start_m); },
          [=](uint32_t k, const Vector3d& tip_m, const Angles&) {
            const Vector3d w = turn(k).inverse() * tip_m - offset_m;
            const double a = wide(delta.upper_m[k]), b = wide(delta.lower_m[k]);
            return roots(w.squaredNorm() + a * a - b * b, -2 * a * w.x(), -2 * a * w.z());
          },
          [=](const Vector3d& tip_m, const Angles& at) { return rods.volume(tip_m, at); },
          [=](const Vector3d& tip_m, const Angles& at) {
            const Vector3d first = end_m(0, at[0]);
            const Vector3d normal = (end_m(1, at[1]) - first).cross(end_m(2, at[2]) - first);
            return (normal.dot(tip_m - first) > 0) == delta.is_tip_above;
          }};
}

Truth truth_of(const SerialArm& arm) {
  // Rotations as frames: about z for the turntable, about -y for a lift of three joints.
  const bool is_planar = arm.joints == 2;
  const Vector3d hinge = is_planar ? Vector3d(0, 0, 1) : Vector3d(0, -1, 0);
  const auto tip_m = [=](const Angles& at, const Vector3d&) -> Vector3d {
    const double first = at[arm.joints - 2];
    const double second = at[arm.joints - 1] + (arm.has_parallelogram ? 0 : first);
    const Vector3d shoulder_m(wide(arm.offset_m), 0, wide(arm.height_m));
    const Vector3d in_plane_m = shoulder_m +
                                AngleAxisd(first, hinge) * Vector3d(wide(arm.link_m[0]), 0, 0) +
                                AngleAxisd(second, hinge) * Vector3d(wide(arm.link_m[1]), 0, 0);
    return AngleAxisd(is_planar ? 0 : at[0], Vector3d::UnitZ()) * in_plane_m;
  };
  const auto inverse = [=](uint32_t k, const Vector3d& goal_m, const Angles& at) {
    if (!is_planar && k == 0) {
      const double t = std::atan2(goal_m.y(), goal_m.x());
      return std::vector<double>{t, t + kPi};
    }
    const Vector3d local = is_planar
                               ? goal_m
                               : Vector3d(AngleAxisd(-at[0], Vector3d::UnitZ()) * goal_m -
                                          Vector3d(wide(arm.offset_m), 0, wide(arm.height_m)));
    const double x = local.x(), y = is_planar ? local.y() : local.z();
    const double a = wide(arm.link_m[0]), b = wide(arm.link_m[1]);
    // By the law of cosines, elbow either way.
    std::vector<double> angles;
    const double bend =
        std::acos(std::clamp((x * x + y * y - a * a - b * b) / (2 * a * b), -1.0, 1.0));
    for (const double elbow : {bend, -bend}) {
      const double first =
          std::atan2(y, x) - std::atan2(b * std::sin(elbow), a + b * std::cos(elbow));
      angles.push_back(k == arm.joints - 2 ? first : elbow + (arm.has_parallelogram ? first : 0));
    }
    return angles;
  };
  return {arm.joints,
          wide(std::min(arm.link_m[0], arm.link_m[1])),
          tip_m,
          inverse,
          [](const Vector3d&, const Angles&) { return 1.0; },
          [](const Vector3d&, const Angles&) { return true; }};
}

double distance_of_angles(double a, double b) { return std::remainder(a - b, 2 * kPi); }

struct Worst {
  double position_m = 0, inverse_m = 0, jacobian = 0, force = 0;
  double condition = 0;  // in units of its bound
  uint32_t poses = 0, singular = 0;
};

Matrix3d differences(const Truth& truth, const Angles& at, const Vector3d& tip_m) {
  constexpr double kStep_rad = 1e-5;
  Matrix3d columns = Matrix3d::Zero();
  for (uint32_t k = 0; k < truth.joints; ++k) {
    Angles above = at, below = at;
    above[k] += kStep_rad;
    below[k] -= kStep_rad;
    columns.col(k) = (truth.tip_m(above, tip_m) - truth.tip_m(below, tip_m)) / (2 * kStep_rad);
  }
  return columns;
}

double reciprocal_condition(const Matrix3d& columns, uint32_t joints) {
  const Eigen::JacobiSVD<Matrix3d> svd(columns);
  double squares = 0, inverses = 0;
  for (uint32_t k = 0; k < joints; ++k) {
    const double s = svd.singularValues()[k];
    squares += s * s;
    inverses += 1 / (s * s);
  }
  return joints / std::sqrt(squares * inverses);
}

// The force that joint torques hold at the tip, by virtual work, against the one passed; relative.
double force_error(const Pose& pose, const Matrix3d& expected, uint32_t joints) {
  device::TorqueLimits limits;
  limits.max_torque_Nm[1] = 0.05f;
  const math::Vec3 passed_N{1.5f, -2.0f, joints == 2 ? 0.0f : 1.0f};
  const device::JointTorques out = torques(pose, limits, passed_N);
  Matrix3d columns = expected;
  if (joints == 2) columns(2, 2) = 1;
  const Vector3d torque_Nm(wide(out.torque_Nm[0]), wide(out.torque_Nm[1]), wide(out.torque_Nm[2]));
  const Vector3d held_N = columns.transpose().fullPivLu().solve(torque_Nm);
  const Vector3d due_N = wide(out.share) * wide(passed_N);
  return (held_N - due_N).norm() / due_N.norm();
}

template <class Linkage>
void compare(const Linkage& linkage, const Truth& truth, const float (&angle_rad)[3],
             Worst& worst) {
  const Pose pose = device::pose_of(linkage, angle_rad);
  if (!(pose.reciprocal_condition >= 0.05f)) {
    ++worst.singular;
    return;
  }
  ++worst.poses;
  const Angles at(wide(angle_rad[0]), wide(angle_rad[1]), wide(angle_rad[2]));
  const Vector3d found_m = wide(pose.position_m);
  const Vector3d tip_m = truth.tip_m(at, found_m);
  CHECK(truth.is_on_branch(found_m, at));
  worst.position_m = std::max(worst.position_m, (tip_m - found_m).norm());
  const Matrix3d expected = differences(truth, at, tip_m);
  Vector3d off = Vector3d::Zero();
  for (uint32_t k = 0; k < truth.joints; ++k) {
    double nearest = HUGE_VAL;
    for (const double t : truth.inverse(k, found_m, at)) {
      const double error = distance_of_angles(t, at[k]);
      if (std::fabs(error) < std::fabs(nearest)) nearest = error;
    }
    off += expected.col(k) * nearest;
  }
  worst.inverse_m = std::max(worst.inverse_m, off.norm());
  Matrix3d columns;
  for (uint32_t k = 0; k < 3; ++k) columns.col(k) = wide(pose.column_m[k]);
  if (pose.reciprocal_condition >= device::TorqueLimits{}.full_from)
    worst.force = std::max(worst.force, force_error(pose, expected, truth.joints));
  if (truth.rods_volume(tip_m, at) < 0.3) return;  // few digits are left of the Jacobian
  const double off_m = (columns - expected).norm(), size_m = expected.norm();
  worst.jacobian = std::max(worst.jacobian, off_m / std::max(size_m, truth.shortest_m));
  // A matrix that is off by e of its norm has a condition that is off by 2 e times itself; 1e-6 are
  // roundings.
  const double condition = reciprocal_condition(expected, truth.joints);
  const double bound = 2 * truth.joints / condition * (off_m / size_m + 1e-6);
  worst.condition =
      std::max(worst.condition, std::fabs(wide(pose.reciprocal_condition) / condition - 1) / bound);
}

// Random poses, away from singularities, each against the oracle.
template <class Linkage>
void attack(const Linkage& linkage, uint32_t seed) {
  CHECK(device::check(linkage).ok());
  test::note("seed", seed);
  const uint32_t poses = test::is_long() ? 1000000 : 50000;
  const Truth truth = truth_of(linkage);
  test::Lcg random(seed);
  Worst worst;
  while (worst.poses < poses && worst.singular < 100 * poses) {
    const float angle_rad[3] = {random.between(-7, 7), random.between(-7, 7),
                                random.between(-7, 7)};
    compare(linkage, truth, angle_rad, worst);
  }
  CHECK_EQ(worst.poses, poses);
  CHECK_LE(worst.position_m, 1e-6);
  CHECK_LE(worst.inverse_m, 1e-6);
  CHECK_LE(worst.jacobian, 1e-5);
  CHECK_LE(worst.condition, 1.0);
  CHECK_LE(worst.force, 5e-3);
}

}  // namespace
#else
namespace {

template <class Linkage>
void attack(const Linkage&, uint32_t) {
  firmtouch::test::skip("Eigen is missing");
}

}  // namespace
#endif

namespace {

const FiveBar kHaply{0, {.07f, .07f}, {.09f, .09f}, true};
const FiveBar kMark2{.025f, {.063f, .063f}, {.075f, .075f}, true};
const FiveBar kUneven{.04f, {.05f, .07f}, {.11f, .08f}, false};
const FiveBar kLopsided{.06f, {.05f, .05f}, {.1f, .025f}, true};
const SerialArm kScara{2, {.15f, .12f}, 0, 0, false};
const SerialArm kTouch{3, {.13f, .13f}, .02f, .12f, false};
const SerialArm kPhantom{3, {.215f, .17f}, 0, .1f, true};
const Delta kFalcon{{.06f, .06f, .06f}, {.103f, .103f, .103f}, .0379f, .0207f, .0045f, true};
const Delta kUnevenDelta{{.1f, .11f, .09f}, {.2f, .19f, .21f}, .06f, .03f, -.01f, false};

}  // namespace

TEST(FiveBar_RandomPoses_AreThoseOfKinematicsInDouble) {
  attack(kHaply, 1);
  attack(kMark2, 2);
  attack(kUneven, 3);
  attack(kLopsided, 9);
}

TEST(SerialArm_RandomPoses_AreThoseOfKinematicsInDouble) {
  attack(kScara, 4);
  attack(kTouch, 5);
  attack(kPhantom, 6);
}

TEST(Delta_RandomPoses_AreThoseOfKinematicsInDouble) {
  attack(kFalcon, 7);
  attack(kUnevenDelta, 8);
}
