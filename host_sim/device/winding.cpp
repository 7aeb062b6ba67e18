#include "host_sim/device/winding.hpp"

#include <cmath>

namespace firmtouch::host_sim {
namespace {

constexpr double kCopper_per_K = 0.0039, kMagnet_per_K = 0.0011;

}  // namespace

void Winding::heat(double torque_Nm, double time_s) {
  if (!(rating_.continuous_Nm > 0)) return;
  const double current = torque_Nm / rating_.continuous_Nm;
  const double a = kCopper_per_K * rating_.winding_rise_K;
  const double gain = current * current / (1 + a);
  const double rate = (1 - gain * a) / rating_.time_s;  // below 0: it runs away
  const double gone = -std::expm1(-rate * time_s);      // share of the difference
  // To 1e-9 where what the resistance adds makes up for what is lost.
  const bool is_even = std::fabs(rate * time_s) < 1e-9;
  x_ += is_even ? gain * time_s / rating_.time_s - x_ * gone
                : (gain / (rating_.time_s * rate) - x_) * gone;
  most_ = std::fmax(most_, x_);
  magnet_ += (x_ - magnet_) * -std::expm1(-time_s / rating_.magnet_time_s);
}

double Winding::torque_share() const { return 1 - kMagnet_per_K * rating_.magnet_rise_K * magnet_; }

}  // namespace firmtouch::host_sim
