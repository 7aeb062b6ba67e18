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

JointMotion moved(const JointMotion& from, const JointMotion& by, double time_s) {
  JointMotion to = from;
  for (uint32_t k = 0; k < kJoints; ++k) {
    to.angle_rad[k] += by.angle_rad[k] * time_s;
    to.rate_rad_per_s[k] += by.rate_rad_per_s[k] * time_s;
  }
  return to;
}

}  // namespace

struct LinkageBody::Inertia {
  double mass[kJoints][kJoints] = {};
  double torque_Nm[kJoints] = {};  // of gravity, less those that the motion itself takes
  Vec tip_column_m[kJoints];
};

LinkageBody::LinkageBody(const LinkageDevice& device, const JointMotion& start)
    : device_(device), joints_(device.joints.joints), motion_(start) {
  const std::vector<tools::Link> links = tools::links_of(device_);
  for (size_t i = 0; i < links.size(); ++i) {
    const tools::Rod& rod = device_.masses.rod[i];
    const double centre = rod.mass_kg * rod.centre_m / links[i].length_m;
    const double second = (rod.inertia_kg_m2 + rod.mass_kg * rod.centre_m * rod.centre_m) /
                          (links[i].length_m * links[i].length_m);
    moments_[i] = {rod.mass_kg - 2 * centre + second, centre - second, second};
  }
  elbows_ = links.size() / 2;
  book_.stored_J = book_.start_J = stored_J();
}

LinkageBody::Inertia LinkageBody::inertia_of(const JointMotion& motion) const {
  const MovingPoints points = points_of(device_, motion);
  const Vec gravity = device_.masses.gravity_mps2;
  Inertia all;
  const auto add = [&](const Moments& m, const MovingPoint& a, const MovingPoint& b) {
    const double near = m.a + m.b, far = m.b + m.c;  // the lever rule
    const Vec at_a = gravity * near - a.bias_mps2 * m.a - b.bias_mps2 * m.b;
    const Vec at_b = gravity * far - a.bias_mps2 * m.b - b.bias_mps2 * m.c;
    for (uint32_t i = 0; i < joints_; ++i) {
      all.torque_Nm[i] += dot(a.column_m[i], at_a) + dot(b.column_m[i], at_b);
      const Vec of_a = a.column_m[i] * m.a + b.column_m[i] * m.b;
      const Vec of_b = a.column_m[i] * m.b + b.column_m[i] * m.c;
      for (uint32_t j = 0; j <= i; ++j)
        all.mass[i][j] += dot(of_a, a.column_m[j]) + dot(of_b, b.column_m[j]);
    }
  };
  for (size_t k = 0; k < elbows_; ++k) {
    add(moments_[k], points.base[k], points.elbow[k]);
    add(moments_[elbows_ + k], points.elbow[k], points.tip);
  }
  add({0, 0, device_.masses.tip_mass_kg}, {}, points.tip);
  for (uint32_t k = 0; k < joints_; ++k) {
    all.mass[k][k] += device_.masses.joint[k].rotor_kg_m2;
    all.tip_column_m[k] = points.tip.column_m[k];
  }
  return all;
}

// Viscous friction and the end stops.
void LinkageBody::loads_of(const JointMotion& motion, double (&torque_Nm)[kJoints],
                           double& lost_W) const {
  for (uint32_t k = 0; k < joints_; ++k) {
    const double rate = motion.rate_rad_per_s[k];
    const double off_rad = beyond(device_.joints.joint[k], motion.angle_rad[k]);
    double damping = device_.masses.joint[k].viscous_N_m_s;
    if (off_rad < 0 || off_rad > 0) damping += device_.masses.stop_N_m_s;
    torque_Nm[k] -= damping * rate + device_.masses.stop_N_m_per_rad * off_rad;
    lost_W += damping * rate * rate;
  }
}

LinkageBody::Rates LinkageBody::rates_of(const JointMotion& motion,
                                         const double (&motor_Nm)[kJoints],
                                         const double (&dry_Nm)[kJoints], Vec hand_N) const {
  const Inertia inertia = inertia_of(motion);
  Rates rates = {};
  double torque_Nm[kJoints] = {};
  loads_of(motion, torque_Nm, rates.lost_W);
  for (uint32_t k = 0; k < joints_; ++k) {
    const double rate = motion.rate_rad_per_s[k], hand_Nm = dot(inertia.tip_column_m[k], hand_N);
    rates.rate[k] = rate;
    rates.hand_W += hand_Nm * rate;
    rates.motors_W += motor_Nm[k] * rate;
    rates.lost_W += dry_Nm[k] * rate;
    rates.acceleration[k] = torque_Nm[k] + inertia.torque_Nm[k] + hand_Nm + motor_Nm[k] - dry_Nm[k];
  }
  (void)solve(joints_, inertia.mass, rates.acceleration);
  return rates;
}

// The box-constrained torques after which an Euler step leaves each joint at rest or against its
// whole friction, by projected Gauss-Seidel.
void LinkageBody::dry_torques(const double (&motor_Nm)[kJoints], Vec hand_N, double time_s,
                              double (&dry_Nm)[kJoints]) const {
  bool is_dry = false;
  for (uint32_t k = 0; k < joints_; ++k) is_dry |= device_.masses.joint[k].coulomb_N_m > 0;
  if (!is_dry) return;
  const Rates without = rates_of(motion_, motor_Nm, dry_Nm, hand_N);
  const Inertia inertia = inertia_of(motion_);
  double inverse[kJoints][kJoints] = {};
  for (uint32_t k = 0; k < joints_; ++k) {
    inverse[k][k] = 1;
    (void)solve(joints_, inertia.mass, inverse[k]);
  }
  for (int sweep = 0; sweep < 40; ++sweep)
    for (uint32_t k = 0; k < joints_; ++k) {
      double rate = motion_.rate_rad_per_s[k] + without.acceleration[k] * time_s;
      for (uint32_t j = 0; j < joints_; ++j) rate -= inverse[k][j] * dry_Nm[j] * time_s;
      const double most = device_.masses.joint[k].coulomb_N_m;
      dry_Nm[k] = std::clamp(dry_Nm[k] + rate / (inverse[k][k] * time_s), -most, most);
    }
}

void LinkageBody::advance(const double (&motor_Nm)[kJoints], Vec hand_N, double time_s) {
  double dry_Nm[kJoints] = {};
  dry_torques(motor_Nm, hand_N, time_s, dry_Nm);
  const double at[] = {0, 0.5, 0.5, 1}, weight[] = {1, 2, 2, 1};
  JointMotion slope, change;
  double hand_J = 0, motors_J = 0, lost_J = 0;
  for (int stage = 0; stage < 4; ++stage) {
    const JointMotion here = moved(motion_, slope, at[stage] * time_s);
    const Rates rates = rates_of(here, motor_Nm, dry_Nm, hand_N);
    const double share = weight[stage] / 6;
    for (uint32_t k = 0; k < joints_; ++k) {
      slope.angle_rad[k] = rates.rate[k];
      slope.rate_rad_per_s[k] = rates.acceleration[k];
    }
    change = moved(change, slope, share);
    hand_J += share * rates.hand_W, motors_J += share * rates.motors_W;
    lost_J += share * rates.lost_W;
  }
  motion_ = moved(motion_, change, time_s);
  book_.hand_J += hand_J * time_s;
  book_.motors_J += motors_J * time_s;
  book_.lost_J += lost_J * time_s;
  book_.stored_J = stored_J();
  book_.turnover_J =
      std::max(book_.turnover_J, std::fabs(book_.stored_J - book_.start_J) + book_.lost_J);
}

double LinkageBody::kinetic_J() const {
  const Inertia inertia = inertia_of(motion_);
  double energy_J = 0;
  for (uint32_t i = 0; i < joints_; ++i)
    for (uint32_t j = 0; j <= i; ++j)
      energy_J += (i == j ? 0.5 : 1) * inertia.mass[i][j] * motion_.rate_rad_per_s[i] *
                  motion_.rate_rad_per_s[j];
  return energy_J;
}

double LinkageBody::stored_J() const {
  const MovingPoints points = points_of(device_, motion_);
  const Vec gravity = device_.masses.gravity_mps2;
  double energy_J = kinetic_J();
  for (size_t k = 0; k < elbows_; ++k) {
    const Moments &driven = moments_[k], &outer = moments_[elbows_ + k];
    energy_J -= (driven.b + driven.c + outer.a + outer.b) * dot(gravity, points.elbow[k].at_m) +
                (driven.a + driven.b) * dot(gravity, points.base[k].at_m) +
                (outer.b + outer.c) * dot(gravity, points.tip.at_m);
  }
  energy_J -= device_.masses.tip_mass_kg * dot(gravity, points.tip.at_m);
  for (uint32_t k = 0; k < joints_; ++k) {
    const double off_rad = beyond(device_.joints.joint[k], motion_.angle_rad[k]);
    energy_J += 0.5 * device_.masses.stop_N_m_per_rad * off_rad * off_rad;
  }
  return energy_J;
}

Vec LinkageBody::tip_force_N(Vec torque_Nm) const {
  const MovingPoint at = tip();
  const Vec third = joints_ == 2 ? Vec{0, 0, 1} : at.column_m[2];
  const Vec first = cross(at.column_m[1], third);
  return (first * torque_Nm.x + cross(third, at.column_m[0]) * torque_Nm.y +
          cross(at.column_m[0], at.column_m[1]) * torque_Nm.z) *
         (1 / dot(at.column_m[0], first));
}

void LinkageBody::holding_torques_Nm(double (&torque_Nm)[kJoints]) const {
  JointMotion still = motion_;
  for (double& rate : still.rate_rad_per_s) rate = 0;
  const Inertia inertia = inertia_of(still);
  for (uint32_t k = 0; k < kJoints; ++k) torque_Nm[k] = -inertia.torque_Nm[k];
}

int32_t LinkageBody::count(uint32_t joint) const {
  if (joint >= joints_) return 0;
  const device::JointSetting& setting = device_.joints.joint[joint];
  const double counts = std::floor((motion_.angle_rad[joint] - wide(setting.zero_rad)) *
                                   wide(setting.counts_per_rad));
  return static_cast<int32_t>(std::clamp(counts, -2147483647.0, 2147483647.0));
}

bool LinkageBody::has_inertia() const {
  double any[kJoints] = {1, 1, 1};
  return solve(joints_, inertia_of(motion_).mass, any);
}

bool find_angles(const LinkageDevice& device, Vec tip_m, JointMotion& motion) {
  motion = {};
  for (uint32_t k = 0; k < device.joints.joints; ++k) {
    const device::JointSetting& joint = device.joints.joint[k];
    motion.angle_rad[k] = 0.5 * (wide(joint.low_rad) + wide(joint.high_rad));
  }
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
