#pragma once
#include "host_sim/device/moving_points.hpp"

namespace firmtouch::host_sim {

/// Where the energy of a simulated linkage went since its start: hand + motors = stored - start +
/// lost.
struct EnergyBook {
  double hand_J = 0, motors_J = 0;  // work done on the linkage
  double lost_J = 0;                // to friction and in the stops
  double stored_J = 0, start_J = 0;
  double turnover_J = 0;  // largest sum of lost and stored energy

  double error_J() const { return hand_J + motors_J - lost_J - (stored_J - start_J); }
};

/// Rigid-body dynamics of a linkage: M(q) q'' = torques - h(q, q') + gravity + J^T hand - friction.
/// A rod's mass lies on the line between its ends, so its inertia follows from its ends' columns
/// alone: a A.A + 2 b A.B + c B.B with the rod's three moments.
/// Integrated by Runge-Kutta of the fourth order. Coulomb friction is constant in a step: what
/// brings a joint to rest, at most coulomb_N_m; with it the order is 1.
class LinkageBody {
 public:
  LinkageBody(const LinkageDevice& device, const JointMotion& start);

  void advance(const double (&motor_Nm)[kJoints], Vec hand_N, double time_s);
  const JointMotion& motion() const { return motion_; }
  MovingPoint tip() const { return points_of(device_, motion_).tip; }
  const EnergyBook& energy() const { return book_; }
  double kinetic_J() const;
  /// The force that these torques hold still at the tip; of a planar linkage in its plane.
  Vec tip_force_N(Vec torque_Nm) const;
  /// Torques that hold it still against gravity, at its angles.
  void holding_torques_Nm(double (&torque_Nm)[kJoints]) const;
  /// Encoder counts, rounded down as an incremental encoder does.
  int32_t count(uint32_t joint) const;
  /// Result: false where the inertia of this pose is not positive definite.
  bool has_inertia() const;

 private:
  struct Inertia;
  struct Rates {
    double rate[kJoints], acceleration[kJoints], hand_W, motors_W, lost_W;
  };
  Inertia inertia_of(const JointMotion& motion) const;
  void loads_of(const JointMotion& motion, double (&torque_Nm)[kJoints], double& lost_W) const;
  Rates rates_of(const JointMotion& motion, const double (&motor_Nm)[kJoints],
                 const double (&dry_Nm)[kJoints], Vec hand_N) const;
  void dry_torques(const double (&motor_Nm)[kJoints], Vec hand_N, double time_s,
                   double (&dry_Nm)[kJoints]) const;
  double stored_J() const;

  LinkageDevice device_;
  uint32_t joints_;
  size_t elbows_ = 0;
  struct Moments {
    double a, b, c;  // of the rod over (1 - s)^2, s (1 - s), s^2, where s goes from 0 to 1
  } moments_[6] = {};
  JointMotion motion_;
  EnergyBook book_;
};

/// Joint angles that put the tip at `tip_m`, within the ranges of the joints.
/// Result: false if Newton's method, from the middle of the ranges, finds none within 1e-9 m.
bool find_angles(const LinkageDevice& device, Vec tip_m, JointMotion& motion);
/// The same from the angles of `motion`.
bool find_angles_from(const LinkageDevice& device, Vec tip_m, JointMotion& motion);

}  // namespace firmtouch::host_sim
