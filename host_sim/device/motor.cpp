#include "host_sim/device/motor.hpp"

#include <cmath>

namespace firmtouch::host_sim {

double Motor::torque_Nm(double wanted_Nm, double rotor_rad, double time_s) {
  double mean_Nm = wanted_Nm;
  if (drive_.lag_s > 0 && time_s > 0) {
    const double gone = -std::expm1(-time_s / drive_.lag_s);  // share of the difference
    const double off_Nm = made_Nm_ - wanted_Nm;
    mean_Nm += off_Nm * gone * drive_.lag_s / time_s;
    made_Nm_ = wanted_Nm + off_Nm * (1 - gone);
  }
  winding_.heat(mean_Nm, time_s);
  mean_Nm *= winding_.torque_share();
  if (!(drive_.poles > 0)) return mean_Nm;
  const double wave = std::sin(drive_.poles * rotor_rad);
  return mean_Nm * (1 + drive_.ripple * wave) + drive_.cogging_N_m * wave;
}

}  // namespace firmtouch::host_sim
