#include "device/calibration_plan.hpp"

#include <algorithm>
#include <cmath>

namespace firmtouch::tools {
namespace {

constexpr int kGrid = 6;  // poses a joint
constexpr double kBall_m = 0.01;
constexpr uint32_t kKinds = 3, kCandidates = 300, kMaxSweeps = 20;

JointMotion pose_of(const LinkageDevice& device, const double (&share)[kJoints]) {
  JointMotion at;
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    const device::JointSetting& joint = device.joints.joint[k];
    at.angle_rad[k] = wide(joint.low_rad) + (wide(joint.high_rad) - wide(joint.low_rad)) * share[k];
  }
  return at;
}

// Covariance of the parameters (scaled), from what is known of them before any touch.
class Covariance {
 public:
  explicit Covariance(size_t parameters)
      : c_(parameters, std::vector<double>(parameters)), along_(parameters) {
    for (size_t i = 0; i < parameters; ++i) c_[i][i] = kMaxDeviation * kMaxDeviation;
  }
  // Adds (sign 1) or removes (-1) the equations of a touch, in units of the noise (Sherman and
  // Morrison). Result: the factor of the information.
  double update(const Matrix& columns, double noise_m, double sign) {
    double factor = 1;
    for (size_t row = 0; row < columns[0].size(); ++row) {
      const double grown = 1 + sign * spread(columns, row) / (noise_m * noise_m);
      factor *= grown;
      const double by = sign / (grown * noise_m * noise_m);
      for (size_t i = 0; i < c_.size(); ++i)
        for (size_t j = 0; j < c_.size(); ++j) c_[i][j] -= by * along_[i] * along_[j];
    }
    return factor;
  }
  // Variance of a residual that follows from that of the parameters.
  double spread(const Matrix& columns, size_t row) {
    double sum = 0;
    for (size_t i = 0; i < c_.size(); ++i) {
      along_[i] = 0;
      for (size_t j = 0; j < c_.size(); ++j) along_[i] += c_[i][j] * columns[j][row];
      sum += along_[i] * columns[i][row];
    }
    return sum;
  }

 private:
  Matrix c_;
  std::vector<double> along_;
};

struct Candidate {
  Touch touch;
  Matrix columns;
};

std::vector<Candidate> candidates_of(const LinkageDevice& device, uint32_t kind, Chance& chance) {
  std::vector<Candidate> all;
  for (uint32_t i = 0; i < kCandidates; ++i) {
    double share[kJoints];
    for (double& each : share) {
      each = chance.share();
      if (i % 2 == 1) each = each < 0.5 ? 0 : 1;
    }
    const Touch touch = touch_at(device, pose_of(device, share), kind, chance);
    Matrix columns = sensitivity(device, {touch}, false);
    if (!columns.empty()) all.push_back({touch, std::move(columns)});
  }
  return all;
}

}  // namespace

double Chance::share() { return (static_cast<double>(engine_()) + 0.5) / 4294967296.0; }

double Chance::normal() {
  return std::sqrt(-2 * std::log(share())) * std::cos(6.283185307179586 * share());
}

Point Chance::noise(bool is_planar) {
  const double x = normal(), y = normal();
  return {x, y, is_planar ? 0 : normal()};
}

JointMotion random_pose(const LinkageDevice& device, Chance& chance) {
  double share[kJoints] = {};
  for (uint32_t k = 0; k < device.joints.joints; ++k) share[k] = chance.share();
  return pose_of(device, share);
}

Touch touch_at(const LinkageDevice& device, const JointMotion& at, uint32_t number,
               Chance& chance) {
  Touch touch;
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    const device::JointSetting& joint = device.joints.joint[k];
    touch.counts[k] = (at.angle_rad[k] - wide(joint.zero_rad)) * wide(joint.counts_per_rad);
  }
  touch.at_m = points_of(device, at).tip.at_m;
  const Point any = chance.noise(device.joints.joints == 2), way = any * (1 / length(any));
  if (number % kKinds == 1) touch.normal = way;
  if (number % kKinds == 2) {
    touch.radius_m = kBall_m;
    touch.at_m = touch.at_m + way * kBall_m;
  }
  return touch;
}

std::vector<Touch> plan_touches(const LinkageDevice& device, uint32_t count, double noise_m) {
  Chance chance(1);
  std::vector<Candidate> pool[kKinds];
  for (uint32_t kind = 0; kind < kKinds; ++kind) {
    pool[kind] = candidates_of(device, kind, chance);
    if (pool[kind].empty()) return {};
  }
  Covariance covariance(parameters_of(device, false).size());
  std::vector<const Candidate*> picks;
  for (uint32_t i = 0; i < count; ++i) {
    const std::vector<Candidate>& from = pool[i % kKinds];
    picks.push_back(&from[i / kKinds % from.size()]);
    covariance.update(picks[i]->columns, noise_m, 1);
  }
  bool is_changed = true;
  for (uint32_t sweep = 0; sweep < kMaxSweeps && is_changed; ++sweep) {
    is_changed = false;
    for (uint32_t i = 0; i < count; ++i) {
      covariance.update(picks[i]->columns, noise_m, -1);
      const Candidate* best = picks[i];
      double most = Covariance(covariance).update(best->columns, noise_m, 1) * (1 + 1e-9);
      for (const Candidate& other : pool[i % kKinds]) {
        const double factor = Covariance(covariance).update(other.columns, noise_m, 1);
        if (factor > most) most = factor, best = &other, is_changed = true;
      }
      picks[i] = best;
      covariance.update(best->columns, noise_m, 1);
    }
  }
  std::vector<Touch> touches;
  for (const Candidate* pick : picks) touches.push_back(pick->touch);
  return touches;
}

std::vector<JointMotion> grid_poses(const LinkageDevice& device) {
  std::vector<JointMotion> poses;
  const int last = device.joints.joints == 3 ? kGrid : 1;
  for (int i = 0; i < kGrid * kGrid * last; ++i) {
    const double share[] = {i % kGrid / (kGrid - 1.0), i / kGrid % kGrid / (kGrid - 1.0),
                            i / kGrid / kGrid / (kGrid - 1.0)};
    poses.push_back(pose_of(device, share));
  }
  return poses;
}

double least_error_m(const LinkageDevice& device, const std::vector<Touch>& touches,
                     double noise_m) {
  const Matrix columns = sensitivity(device, touches, false);
  if (columns.empty()) return HUGE_VAL;
  Covariance covariance(columns.size());
  covariance.update(columns, noise_m, 1);
  Chance chance(1);
  double worst_m2 = 0;
  for (const JointMotion& at : grid_poses(device)) {
    const Matrix tip = sensitivity(device, {touch_at(device, at, 0, chance)}, false);
    if (tip.empty()) return HUGE_VAL;
    double sum_m2 = 0;
    for (size_t row = 0; row < tip[0].size(); ++row) sum_m2 += covariance.spread(tip, row);
    worst_m2 = std::max(worst_m2, sum_m2);
  }
  return std::sqrt(worst_m2);
}

}  // namespace firmtouch::tools
