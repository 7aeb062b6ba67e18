// Calibration from touches: against Eigen's least squares, and in the words of its study.
#include "device/calibrate.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "device/calibration_plan.hpp"
#include "device/calibration_study.hpp"
#include "device/machines.hpp"
#include "device/moving_points.hpp"
#include "harness/random.hpp"
#include "harness/test.hpp"

#if __has_include(<Eigen/Dense>)
#include <Eigen/Dense>

using namespace firmtouch;  // NOLINT: a test file
using tools::Calibration;
using tools::LinkageDevice;

namespace {

constexpr double kNoise_m = 20e-6;

LinkageDevice machine(const std::string& name) {
  return tools::read_device(name, tools::machine_text(name));
}

// Points that the true arm touches, in a share of its joints' ranges about their middles.
std::vector<tools::Touch> points(const LinkageDevice& device, uint32_t count, double share = 1) {
  test::Lcg random(7);
  std::vector<tools::Touch> touches(count);
  for (tools::Touch& touch : touches) {
    tools::JointMotion at;
    for (uint32_t k = 0; k < 3; ++k) {
      const device::JointSetting& joint = device.joints.joint[k];
      const double low_rad = static_cast<double>(joint.low_rad),
                   half_rad = (static_cast<double>(joint.high_rad) - low_rad) / 2;
      at.angle_rad[k] =
          low_rad + half_rad * (1 + share * static_cast<double>(random.between(-1, 1)));
      touch.counts[k] = (at.angle_rad[k] - static_cast<double>(joint.zero_rad)) *
                        static_cast<double>(joint.counts_per_rad);
    }
    touch.at_m = tools::points_of(device, at).tip.at_m;
    touch.at_m.x += kNoise_m * static_cast<double>(random.between(-1, 1));
  }
  return touches;
}

// The tip of touch_like by its own formula: link_0, link_1, offset, height, zeros.
Eigen::Vector3d tip(const Eigen::VectorXd& p, const tools::Touch& touch, double per_rad) {
  const double turn = p[4] + touch.counts[0] / per_rad, upper = p[5] + touch.counts[1] / per_rad;
  const double lower = upper + p[6] + touch.counts[2] / per_rad;
  const double out = p[2] + p[0] * std::cos(upper) + p[1] * std::cos(lower);
  return {out * std::cos(turn), out * std::sin(turn),
          p[3] + p[0] * std::sin(upper) + p[1] * std::sin(lower)};
}

}  // namespace

TEST(Calibrate_TouchLike_IsEigensLeastSquares) {
  const LinkageDevice device = machine("touch_like");
  const double per_rad = static_cast<double>(device.joints.joint[0].counts_per_rad);
  const std::vector<tools::Touch> touches = points(device, 40);
  LinkageDevice start = device;
  std::get<device::SerialArm>(start.linkage).link_m[0] *= 1.05f;
  std::get<device::SerialArm>(start.linkage).link_m[1] *= 0.95f;
  const Calibration found = calibrate(start, touches, kNoise_m, false);
  CHECK(found.has_converged);
  CHECK_EQ(found.determined, 7u);
  // Gauss-Newton with Eigen's inverse, derivatives by central differences.
  Eigen::VectorXd p(7);
  for (int i = 0; i < 7; ++i) p[i] = found.parameters[static_cast<size_t>(i)].before;
  Eigen::MatrixXd jacobian(120, 7), inverse;
  for (int round = 0; round < 20; ++round) {
    Eigen::VectorXd off(120);
    for (int t = 0; t < 40; ++t) {
      const tools::Touch& touch = touches[static_cast<size_t>(t)];
      const Eigen::Vector3d at(touch.at_m.x, touch.at_m.y, touch.at_m.z);
      off.segment<3>(3 * t) = tip(p, touch, per_rad) - at;
      for (int i = 0; i < 7; ++i) {
        Eigen::VectorXd high = p, low = p;
        high[i] += 1e-6, low[i] -= 1e-6;
        jacobian.block<3, 1>(3 * t, i) =
            (tip(high, touch, per_rad) - tip(low, touch, per_rad)) / 2e-6;
      }
    }
    inverse = (jacobian.transpose() * jacobian).inverse();
    p -= inverse * (jacobian.transpose() * off);
  }
  const Eigen::MatrixXd covariance = kNoise_m * kNoise_m * inverse;
  for (int i = 0; i < 7; ++i) {
    const tools::Calibrated& parameter = found.parameters[static_cast<size_t>(i)];
    test::note(parameter.name.c_str(), static_cast<uint32_t>(i));
    CHECK(parameter.is_determined);
    CHECK_LE(std::fabs(parameter.value - p[i]), 2e-7);  // float32 of the device file
    CHECK_LE(std::fabs(parameter.deviation / std::sqrt(covariance(i, i)) - 1), 1e-3);
  }
}

TEST(Directions_AreEigensEigenvectors) {
  test::Lcg random(3);
  for (int n = 1; n <= 12; ++n) {
    Eigen::MatrixXd half(n, n);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) half(i, j) = static_cast<double>(random.between(-1, 1));
    if (n > 4) half.col(0) = half.col(1);  // a null direction
    const Eigen::MatrixXd square = half.transpose() * half;
    tools::Matrix ours(static_cast<size_t>(n), std::vector<double>(static_cast<size_t>(n)));
    for (size_t i = 0; i < ours.size(); ++i)
      for (size_t j = 0; j < ours.size(); ++j)
        ours[i][j] = square(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
    const tools::Directions found = tools::directions_of(ours);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> oracle(square);
    for (int d = 0; d < n; ++d) {
      const auto k = static_cast<size_t>(d);
      CHECK_LE(std::fabs(found.value[k] - oracle.eigenvalues()[n - 1 - d]), 1e-12 * found.value[0]);
      const Eigen::VectorXd way = Eigen::Map<const Eigen::VectorXd>(found.way[k].data(), n);
      CHECK_LE((square * way - found.value[k] * way).norm(), 1e-12 * found.value[0]);
    }
  }
}

// Only the difference of a delta's radii moves its tip.
TEST(Calibrate_NamesWhatTouchesLeaveOpen) {
  const LinkageDevice device = machine("falcon_like");
  const Calibration found = calibrate(device, points(device, 60), kNoise_m, false);
  CHECK(found.has_converged);
  CHECK_EQ(found.determined, static_cast<uint32_t>(found.parameters.size()) - 1);
  for (const tools::Calibrated& parameter : found.parameters)
    CHECK_EQ(parameter.is_determined,
             parameter.name != "base_radius" && parameter.name != "platform_radius");
}

// Touches of nearly one pose leave directions open; these stay as they were.
TEST(Calibrate_TouchesOfNearlyOnePose_LeaveDirectionsOpen) {
  const LinkageDevice device = machine("touch_like");
  const Calibration found = calibrate(device, points(device, 40, 0.001), kNoise_m, false);
  CHECK_LE(found.determined, static_cast<uint32_t>(found.parameters.size()) - 2);
  CHECK_GE(found.determined, 2u);
  for (const tools::Calibrated& parameter : found.parameters)
    CHECK_LE(std::fabs(parameter.value - parameter.before), 2e-3);
}

// Sherman and Morrison's covariance against Eigen's inverse, and a plan against touches anywhere.
TEST(Plan_LeavesTheErrorThatEigenComputes_AndLessThanTouchesAnywhere) {
  for (const std::string& name : tools::machine_names()) {
    test::note(name.c_str(), 0);
    const LinkageDevice device = machine(name);
    const std::vector<tools::Touch> plan = tools::plan_touches(device, 40, kNoise_m);
    const auto eigen = [](const tools::Matrix& columns) {
      Eigen::MatrixXd all(columns[0].size(), columns.size());
      for (size_t i = 0; i < columns.size(); ++i)
        all.col(static_cast<Eigen::Index>(i)) =
            Eigen::Map<const Eigen::VectorXd>(columns[i].data(), all.rows());
      return all;
    };
    const Eigen::MatrixXd jacobian = eigen(sensitivity(device, plan, false));
    Eigen::MatrixXd information = jacobian.transpose() * jacobian / (kNoise_m * kNoise_m);
    information.diagonal().array() += 1 / (tools::kMaxDeviation * tools::kMaxDeviation);
    const Eigen::MatrixXd covariance = information.inverse();
    tools::Chance any(2);
    double worst_m = 0;
    for (const tools::JointMotion& at : tools::grid_poses(device)) {
      const Eigen::MatrixXd tip =
          eigen(sensitivity(device, {tools::touch_at(device, at, 0, any)}, false));
      worst_m = std::max(worst_m, std::sqrt((tip * covariance * tip.transpose()).trace()));
    }
    const double bound_m = tools::least_error_m(device, plan, kNoise_m);
    CHECK_LE(std::fabs(bound_m / worst_m - 1), 1e-4);
    std::vector<tools::Touch> anywhere;
    for (uint32_t i = 0; i < 40; ++i)
      anywhere.push_back(tools::touch_at(device, tools::random_pose(device, any), i, any));
    CHECK_LE(bound_m, 0.75 * tools::least_error_m(device, anywhere, kNoise_m));
  }
}

TEST(Calibrate_TruthIsInTheEllipsoid_AndTheTipIsWithin50Micrometres) {
  for (const std::string& name : tools::machine_names()) {
    const tools::CalibrationStudy study = study_calibration(machine(name), {});
    test::note(name.c_str(), study.in_ellipsoid);
    CHECK_EQ(study.converged, study.runs);
    CHECK_LE(study.worst_m, 50e-6);
    CHECK_GE(study.median_m, study.bound_m);  // the largest over the workspace is no mean
    CHECK_GE(study.before_m, 2e-3);
    const double share = static_cast<double>(study.in_ellipsoid) / study.runs;
    CHECK_GE(share, 0.93);
    CHECK_LE(share, 0.97);
  }
}

#endif
