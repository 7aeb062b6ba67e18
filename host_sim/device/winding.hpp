#pragma once
namespace firmtouch::host_sim {

/// What a data sheet says of a motor's heat, at the joint.
struct MotorRating {
  double continuous_Nm = 0;    // torque for ever; 0: not stated, and nothing heats
  double time_s = 0;           // thermal time constant of the winding
  double winding_rise_K = 80;  // of the winding above its surroundings at that torque
  double magnet_rise_K = 0;    // of the magnets, behind the winding
  double magnet_time_s = 300;
};

/// Temperatures of a motor whose amplifier gives the current of a cold motor's torque. x is the
/// winding's rise in units of the rated one: T x' = i^2 (1 + a x) / (1 + a) - x, with the current i
/// in units of the continuous one, and a = 0.0039 / K of copper times the rated rise. The magnets
/// follow the winding by their own first order; their torque falls by 0.11 % / K (neodymium).
class Winding {
 public:
  Winding() = default;
  explicit Winding(const MotorRating& rating) : rating_(rating) {}

  /// The amplifier makes `torque_Nm` for `time_s`: exact of the winding.
  void heat(double torque_Nm, double time_s);
  /// What the magnets leave of a torque.
  double torque_share() const;
  double rise() const { return x_; }
  double largest_rise() const { return most_; }
  double rated_K() const { return rating_.winding_rise_K; }

 private:
  MotorRating rating_;
  double x_ = 0, magnet_ = 0, most_ = 0;  // from cold
};

}  // namespace firmtouch::host_sim
