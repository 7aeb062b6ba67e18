#include "host_sim/device/linkage_body.hpp"

#include <algorithm>
#include <cmath>

namespace firmtouch::host_sim {
namespace {

double wide(float a) { return static_cast<double>(a); }

// Solves the symmetric system of the first `n` unknowns by Cholesky's factors.
// Result: false if `m` is not positive definite.
bool solve(uint32_t n, const double (&m)[kJoints][kJoints], double (&x)[kJoints]) {
  double l[kJoints][kJoints] = {};
  for (uint32_t i = 0; i < n; ++i)
    for (uint32_t j = 0; j <= i; ++j) {
      double sum = m[i][j];
      for (uint32_t k = 0; k < j; ++k) sum -= l[i][k] * l[j][k];
      if (i != j) {
        l[i][j] = sum / l[j][j];
      } else if (sum > 0) {
        l[i][i] = std::sqrt(sum);
      } else {
        return false;
      }
    }
  for (uint32_t i = 0; i < n; ++i) {
    for (uint32_t k = 0; k < i; ++k) x[i] -= l[i][k] * x[k];
    x[i] /= l[i][i];
  }
  for (uint32_t i = n; i-- > 0;) {
    for (uint32_t k = i + 1; k < n; ++k) x[i] -= l[k][i] * x[k];
    x[i] /= l[i][i];
  }
  return true;
}

// Angle beyond the range of a joint; its sign says on which side.
double beyond(const device::JointSetting& joint, double angle_rad) {
  return angle_rad - std::clamp(angle_rad, wide(joint.low_rad), wide(joint.high_rad));
}

}  // namespace

LinkageBody::LinkageBody(const LinkageDevice& device, const JointMotion& start)
    : device_(device), joints_(device.joints.joints), motion_(start) {
  moments_ = tools::moments_of(device_);
  elbows_ = moments_.size() / 2;
  for (uint32_t k = 0; k < joints_; ++k) {
    is_dry_ |= most_dry_Nm(k) > 0;
  }
  here_ = before_ = dynamics_of(motion_);
  book_.stored_J = book_.start_J = here_.stored_J;
  book_.weight_J = here_.weight_J;
}

double LinkageBody::most_dry_Nm(uint32_t joint) const {
  const tools::JointFriction& friction = device_.masses.joint[joint];
  if (!(friction.stribeck_rad_per_s > 0)) return friction.coulomb_N_m;
  const double rates = motion_.rate_rad_per_s[joint] / friction.stribeck_rad_per_s;
  return friction.coulomb_N_m +
         (friction.breakaway_N_m - friction.coulomb_N_m) * std::exp(-rates * rates);
}

void LinkageBody::add_links(const MovingPoints& points, Dynamics& to) const {
  const Vec gravity = device_.masses.gravity_mps2;
  const auto load = [&](const MovingPoint& p, double heavy_kg, Vec inertial_N) {
    const Vec force_N = gravity * heavy_kg - inertial_N;
    for (uint32_t i = p.first; i < p.end; ++i) to.torque_Nm[i] += dot(p.column_m[i], force_N);
    to.weight_J -= heavy_kg * dot(gravity, p.at_m);
  };
  const MovingPoint& tip = points.tip;
  double at_tip_kg = device_.masses.tip_mass_kg, weight_of_tip_kg = at_tip_kg;
  Vec by_elbows_N;
  for (size_t k = 0; k < elbows_; ++k) {
    const tools::RodMoments &driven = moments_[k], &outer = moments_[elbows_ + k];
    const MovingPoint &base = points.base[k], &elbow = points.elbow[k];
    const double at_elbow_kg = driven.c + outer.a;
    load(base, driven.a + driven.b, base.bias_mps2 * driven.a + elbow.bias_mps2 * driven.b);
    load(elbow, driven.b + driven.c + outer.a + outer.b,
         base.bias_mps2 * driven.b + elbow.bias_mps2 * at_elbow_kg + tip.bias_mps2 * outer.b);
    at_tip_kg += outer.c, weight_of_tip_kg += outer.b + outer.c;  // the lever rule
    by_elbows_N = by_elbows_N + elbow.bias_mps2 * outer.b;
  }
  load(tip, weight_of_tip_kg, by_elbows_N + tip.bias_mps2 * at_tip_kg);
}

// Springs that balance the weight: their energy is part of its.
void LinkageBody::add_springs(const JointMotion& motion, Dynamics& to) const {
  for (uint32_t k = 0; k < joints_; ++k) {
    const tools::JointFriction& joint = device_.masses.joint[k];
    const double off_rad = motion.angle_rad[k] - joint.relaxed_rad;
    to.torque_Nm[k] -= joint.spring_N_m_per_rad * off_rad;
    to.weight_J += 0.5 * joint.spring_N_m_per_rad * off_rad * off_rad;
  }
}

void LinkageBody::add_stops(const JointMotion& motion, Dynamics& to) const {
  for (uint32_t k = 0; k < joints_; ++k) {
    const double off_rad = beyond(device_.joints.joint[k], motion.angle_rad[k]);
    const double stop_Nm = device_.masses.stop_N_m_per_rad * off_rad;
    double damping = device_.masses.joint[k].viscous_N_m_s;
    if (off_rad < 0 || off_rad > 0) damping += device_.masses.stop_N_m_s;
    to.resisting_Nm[k] = damping * motion.rate_rad_per_s[k];
    to.torque_Nm[k] -= stop_Nm;
    to.stored_J += 0.5 * stop_Nm * off_rad;
  }
}

LinkageBody::Dynamics LinkageBody::dynamics_of(const JointMotion& motion) const {
  const MovingPoints points = points_of(device_, motion);
  Dynamics all;
  all.is_closed = points.is_closed && points.span >= kMinSpan;
  all.tip = points.tip;
  add_links(points, all);
  add_springs(motion, all);
  double mass[kJoints][kJoints];
  tools::put_inertia(device_, moments_, points, mass);
  all.has_inertia = tools::invert(mass, all.inverse);
  for (uint32_t k = joints_; k < kJoints; ++k) all.inverse[k][k] = 0;
  for (uint32_t i = 0; i < kJoints; ++i)
    for (uint32_t j = 0; j < kJoints; ++j)
      all.kinetic_J += 0.5 * mass[i][j] * motion.rate_rad_per_s[i] * motion.rate_rad_per_s[j];
  all.stored_J = all.kinetic_J + all.weight_J;
  add_stops(motion, all);
  return all;
}

void LinkageBody::load(const Dynamics& at, Vec hand_N, double (&load_Nm)[kJoints]) {
  for (uint32_t k = 0; k < kJoints; ++k)
    load_Nm[k] = at.torque_Nm[k] - at.resisting_Nm[k] + dot(at.tip.column_m[k], hand_N);
}

void LinkageBody::accelerate(const Dynamics& at, const double (&load_Nm)[kJoints],
                             const double (&motor_Nm)[kJoints], double (&acceleration)[kJoints]) {
  double torque_Nm[kJoints];
  for (uint32_t k = 0; k < kJoints; ++k) torque_Nm[k] = load_Nm[k] + motor_Nm[k];
  for (uint32_t k = 0; k < kJoints; ++k)
    acceleration[k] = at.inverse[k][0] * torque_Nm[0] + at.inverse[k][1] * torque_Nm[1] +
                      at.inverse[k][2] * torque_Nm[2];
}

// `old`: share of the step before. `free`: rates after the step without friction.
void LinkageBody::dry_torques(const double (&free)[kJoints], double old, double time_s,
                              double (&dry_Nm)[kJoints]) {
  double change[kJoints][kJoints];  // of the rates by each torque
  for (uint32_t k = 0; k < kJoints; ++k)
    for (uint32_t j = 0; j < kJoints; ++j)
      change[k][j] = time_s * ((1 + old) * here_.inverse[k][j] - old * before_.inverse[k][j]);
  double most_Nm[kJoints] = {};
  for (uint32_t k = 0; k < joints_; ++k) most_Nm[k] = most_dry_Nm(k);
  dry_.torques(joints_, change, free, most_Nm, dry_Nm);
}

bool LinkageBody::is_sound(const JointMotion& motion, const Dynamics& dynamics) const {
  bool is_slow = true;
  for (uint32_t k = 0; k < joints_; ++k)
    is_slow &= std::fabs(motion.rate_rad_per_s[k]) <= kMaxRate_rad_per_s;
  return is_slow && dynamics.is_closed && dynamics.has_inertia &&
         std::isfinite(dynamics.stored_J) && std::isfinite(norm(dynamics.tip.at_m));
}

void LinkageBody::jam() {
  ++jams_;
  for (double& rate : motion_.rate_rad_per_s) rate = 0;
  book_.lost_J += here_.kinetic_J;
  here_ = before_ = dynamics_of(motion_);
}

LinkageBody::Step LinkageBody::step(const double (&motor_Nm)[kJoints], Vec hand_N, double time_s) {
  JointMotion next = motion_;
  const double old = 0.5 * time_s / before_s_;
  double now[kJoints], earlier[kJoints], after[kJoints], dry_Nm[kJoints] = {}, torque_Nm[kJoints];
  double here_Nm[kJoints], before_Nm[kJoints], then_Nm[kJoints];
  load(here_, hand_N, here_Nm);
  load(before_, hand_N, before_Nm);
  const auto predict = [&] {
    for (uint32_t k = 0; k < kJoints; ++k) torque_Nm[k] = motor_Nm[k] - dry_Nm[k];
    accelerate(here_, here_Nm, torque_Nm, now);
    accelerate(before_, before_Nm, torque_Nm, earlier);
    for (uint32_t k = 0; k < kJoints; ++k)
      next.rate_rad_per_s[k] =
          motion_.rate_rad_per_s[k] + time_s * ((1 + old) * now[k] - old * earlier[k]);
  };
  predict();
  if (is_dry_) {
    dry_torques(next.rate_rad_per_s, old, time_s, dry_Nm);
    predict();
  }
  for (uint32_t k = 0; k < kJoints; ++k)
    next.angle_rad[k] += 0.5 * time_s * (motion_.rate_rad_per_s[k] + next.rate_rad_per_s[k]);
  const Dynamics then = dynamics_of(next);
  load(then, hand_N, then_Nm);
  accelerate(then, then_Nm, torque_Nm, after);
  double error = 0, motors_J = 0, lost_J = 0;
  for (uint32_t k = 0; k < kJoints; ++k) {
    const double off = time_s * (0.5 * (after[k] - now[k]) - old * (now[k] - earlier[k]));
    error = std::max(error, std::fabs(off));
    next.rate_rad_per_s[k] += off * (5.0 / 6);
    next.angle_rad[k] += time_s * time_s / 12 * (now[k] - after[k]);
    const double turn_rad = next.angle_rad[k] - motion_.angle_rad[k];
    motors_J += motor_Nm[k] * turn_rad;
    lost_J += (dry_Nm[k] + 0.5 * (here_.resisting_Nm[k] + then.resisting_Nm[k])) * turn_rad;
  }
  const bool is_good = is_sound(next, then);
  if (!(is_good && error <= kMaxError_rad_per_s) && halvings_ < kMaxHalvings) return Step::kTooLong;
  if (!is_good) return Step::kImpossible;
  book_.hand_J += dot(hand_N, then.tip.at_m - here_.tip.at_m);
  book_.motors_J += motors_J;
  book_.lost_J += lost_J;
  motion_ = next;
  before_ = here_;
  here_ = then;
  before_s_ = time_s;
  return Step::kDone;
}

void LinkageBody::advance(const double (&motor_Nm)[kJoints], Vec hand_N, double time_s) {
  if (halvings_ > 0) --halvings_;
  uint32_t parts = 1u << halvings_;  // that are left, of the present length
  while (parts > 0) {
    const Step result = step(motor_Nm, hand_N, time_s / (1u << halvings_));
    if (result == Step::kImpossible) {
      jam();
      break;
    }
    if (result == Step::kTooLong) {
      ++halvings_, parts *= 2;
    } else {
      --parts;
      if (parts > 0 && parts % 2 == 0 && halvings_ > 0) --halvings_, parts /= 2;
    }
  }
  book_.stored_J = here_.stored_J;
  book_.weight_J = here_.weight_J;
  book_.turnover_J =
      std::max(book_.turnover_J, std::fabs(book_.stored_J - book_.start_J) + book_.lost_J);
}

Vec LinkageBody::tip_force_N(Vec torque_Nm) const {
  const MovingPoint& at = tip();
  const Vec third = joints_ == 2 ? Vec{0, 0, 1} : at.column_m[2];
  const Vec first = cross(at.column_m[1], third);
  return (first * torque_Nm.x + cross(third, at.column_m[0]) * torque_Nm.y +
          cross(at.column_m[0], at.column_m[1]) * torque_Nm.z) *
         (1 / dot(at.column_m[0], first));
}

void LinkageBody::holding_torques_Nm(double (&torque_Nm)[kJoints]) const {
  JointMotion still = motion_;
  for (double& rate : still.rate_rad_per_s) rate = 0;
  const Dynamics at = dynamics_of(still);
  for (uint32_t k = 0; k < kJoints; ++k) torque_Nm[k] = -at.torque_Nm[k];
}

int32_t LinkageBody::count_at(uint32_t joint, double angle_rad) const {
  if (joint >= joints_) return 0;
  const device::JointSetting& setting = device_.joints.joint[joint];
  const double counts =
      std::floor((angle_rad - wide(setting.zero_rad)) * wide(setting.counts_per_rad));
  return static_cast<int32_t>(std::clamp(counts, -2147483647.0, 2147483647.0));
}

void check_inertia(const LinkageBody& body, const std::string& name) {
  if (!body.has_inertia())
    throw tools::Refused(name +
                         ": its inertia is not positive definite; give each joint a rotor_ or its "
                         "links masses");
}

JointMotion middle_of(const LinkageDevice& device) {
  JointMotion middle;
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    const device::JointSetting& joint = device.joints.joint[k];
    middle.angle_rad[k] = 0.5 * (wide(joint.low_rad) + wide(joint.high_rad));
  }
  return middle;
}

double reciprocal_condition(const LinkageDevice& device, const JointMotion& at) {
  float angle_rad[kJoints];
  for (uint32_t k = 0; k < kJoints; ++k) angle_rad[k] = static_cast<float>(at.angle_rad[k]);
  return std::visit(
      [&](const auto& linkage) {
        return wide(device::pose_of(linkage, angle_rad).reciprocal_condition);
      },
      device.linkage);
}

bool find_angles(const LinkageDevice& device, Vec tip_m, JointMotion& motion) {
  motion = middle_of(device);
  return find_angles_from(device, tip_m, motion);
}

bool find_angles_from(const LinkageDevice& device, Vec tip_m, JointMotion& motion) {
  for (int step = 0; step < 100; ++step) {
    const MovingPoint tip = points_of(device, motion).tip;
    const Vec off = tip_m - tip.at_m;
    if (norm(off) <= 1e-9) return true;
    // Least squares: J^T J change = J^T off.
    double square[kJoints][kJoints], change[kJoints] = {};
    for (uint32_t i = 0; i < device.joints.joints; ++i) {
      change[i] = dot(tip.column_m[i], off);
      for (uint32_t j = 0; j <= i; ++j) square[i][j] = dot(tip.column_m[i], tip.column_m[j]);
    }
    if (!solve(device.joints.joints, square, change)) return false;
    for (uint32_t k = 0; k < device.joints.joints; ++k) {
      const device::JointSetting& joint = device.joints.joint[k];
      motion.angle_rad[k] = std::clamp(motion.angle_rad[k] + std::clamp(change[k], -0.3, 0.3),
                                       wide(joint.low_rad), wide(joint.high_rad));
    }
  }
  return false;
}

}  // namespace firmtouch::host_sim
