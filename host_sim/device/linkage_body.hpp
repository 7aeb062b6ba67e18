#pragma once
#include <string>

#include "device/inertia.hpp"
#include "host_sim/device/dry_friction.hpp"
#include "host_sim/plant/vec.hpp"

namespace firmtouch::host_sim {

using tools::JointMotion;
using tools::kJoints;
using tools::LinkageDevice;
using tools::MovingPoint;
using tools::MovingPoints;
using tools::points_of;

/// Where the energy of a simulated linkage went since its start: hand + motors = stored - start +
/// lost.
struct EnergyBook {
  double hand_J = 0, motors_J = 0;  // work done on the linkage
  double lost_J = 0;                // to friction and in the stops
  double stored_J = 0, start_J = 0;
  double weight_J = 0;    // part of stored_J: of the weight and of what balances it
  double turnover_J = 0;  // largest sum of lost and stored energy

  double error_J() const { return hand_J + motors_J - lost_J - (stored_J - start_J); }
};

/// Rigid-body dynamics of a linkage: M(q) q'' = torques - h(q, q') + gravity + springs + J^T hand -
/// friction.
/// Integrated in the third order with one evaluation a step, motors and hand constant: rates by
/// Adams and Bashforth's second order and angles by the trapezoid rule, corrected by the change of
/// acceleration that follows. Where the rates differ from the trapezoid rule's by more than
/// kMaxError_rad_per_s, the step is halved, at most kMaxHalvings times: at stops and near
/// singularities. Dry friction is constant in a step: what brings a joint to rest, at most
/// most_dry_Nm(); with it the order is 1.
/// The ends of the joints' ranges are springs with dampers. Where the links of a loop would come
/// into one line (span below kMinSpan), a joint would exceed kMaxRate_rad_per_s or anything would
/// not be finite, the linkage jams until the time passed to advance() is over: it keeps its angles,
/// and its kinetic energy is lost. It leaves where torques lead it back. So its motion is finite
/// under every torque and every hand.
class LinkageBody {
 public:
  static constexpr double kMinSpan = 1e-3, kMaxRate_rad_per_s = 1e4;
  static constexpr double kMaxError_rad_per_s = 1e-8;
  static constexpr uint32_t kMaxHalvings = 6;

  LinkageBody(const LinkageDevice& device, const JointMotion& start);

  void advance(const double (&motor_Nm)[kJoints], Vec hand_N, double time_s);
  const JointMotion& motion() const { return motion_; }
  const MovingPoint& tip() const { return here_.tip; }
  const EnergyBook& energy() const { return book_; }
  double kinetic_J() const { return here_.kinetic_J; }
  uint64_t jams() const { return jams_; }
  /// The force that these torques hold still at the tip; of a planar linkage in its plane.
  Vec tip_force_N(Vec torque_Nm) const;
  /// Torques that hold it still against gravity and springs, at its angles.
  void holding_torques_Nm(double (&torque_Nm)[kJoints]) const;
  /// Encoder counts, rounded down as an incremental encoder does.
  int32_t count(uint32_t joint) const { return count_at(joint, motion_.angle_rad[joint]); }
  int32_t count_at(uint32_t joint, double angle_rad) const;
  /// Acceleration of joint `i` by a torque of joint `j`.
  double inverse_inertia(uint32_t i, uint32_t j) const { return here_.inverse[i][j]; }
  /// Of the pose at the start: the links of a loop meet, and not in one line.
  bool is_closed() const { return here_.is_closed; }
  /// Result: false where the inertia of this pose is not positive definite.
  bool has_inertia() const { return here_.has_inertia; }

 private:
  struct Dynamics {
    bool is_closed = false, has_inertia = false;
    double inverse[kJoints][kJoints];   // of the inertia
    double torque_Nm[kJoints] = {};     // of gravity and springs, less what the motion itself takes
    double resisting_Nm[kJoints] = {};  // viscous friction and the stops
    double kinetic_J = 0, weight_J = 0;
    double stored_J = 0;  // kinetic, of weight and of the stops
    MovingPoint tip;
  };
  Dynamics dynamics_of(const JointMotion& motion) const;
  void add_links(const MovingPoints& points, Dynamics& to) const;
  void add_springs(const JointMotion& motion, Dynamics& to) const;
  void add_stops(const JointMotion& motion, Dynamics& to) const;
  // Torques without motors and Coulomb friction, and what all torques do.
  static void load(const Dynamics& at, Vec hand_N, double (&load_Nm)[kJoints]);
  static void accelerate(const Dynamics& at, const double (&load_Nm)[kJoints],
                         const double (&motor_Nm)[kJoints], double (&acceleration)[kJoints]);
  // Of a joint at its rate; Gauss's curve of Stribeck friction (Armstrong-Helouvry, Dupont &
  // Canudas de Wit 1994).
  double most_dry_Nm(uint32_t joint) const;
  void dry_torques(const double (&free)[kJoints], double old, double time_s,
                   double (&dry_Nm)[kJoints]);
  bool is_sound(const JointMotion& motion, const Dynamics& dynamics) const;
  void jam();
  enum class Step { kDone, kTooLong, kImpossible };  // only kDone moves it
  Step step(const double (&motor_Nm)[kJoints], Vec hand_N, double time_s);

  LinkageDevice device_;
  uint32_t joints_;
  size_t elbows_ = 0;
  bool is_dry_ = false;  // has dry friction
  DryFriction dry_;
  std::vector<tools::RodMoments> moments_;
  JointMotion motion_;
  Dynamics here_, before_;  // of motion_, and of a step ago
  double before_s_ = 1;     // length of that step
  uint32_t halvings_ = 0;   // of the last step
  EnergyBook book_;
  uint64_t jams_ = 0;
};

/// Throws Refused if the linkage `name` cannot be simulated: its inertia is not positive definite.
void check_inertia(const LinkageBody& body, const std::string& name);

/// Of the ranges of its joints.
JointMotion middle_of(const LinkageDevice& device);

/// Of its Jacobian, as the firmware computes it.
double reciprocal_condition(const LinkageDevice& device, const JointMotion& at);

/// Joint angles that put the tip at `tip_m`, within the ranges of the joints.
/// Result: false if Newton's method, from the middle of the ranges, finds none within 1e-9 m.
bool find_angles(const LinkageDevice& device, Vec tip_m, JointMotion& motion);
/// The same from the angles of `motion`.
bool find_angles_from(const LinkageDevice& device, Vec tip_m, JointMotion& motion);

}  // namespace firmtouch::host_sim
