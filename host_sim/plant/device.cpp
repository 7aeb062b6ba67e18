#include "host_sim/plant/device.hpp"

#include <algorithm>
#include <cmath>

namespace firmtouch::host_sim {
namespace {

// Below this many time constants the exponentials cancel; the series is exact to rounding there.
constexpr double kShort = 1e-5;

// Solves m dv/dt = F - b v over `time_s`.
void glide(const DeviceModel& model, double force_N, double time_s, double& x, double& v) {
  const double rate = model.viscous_N_s_per_m / model.mass_kg * time_s;
  if (rate < kShort) {
    const double a = (force_N - model.viscous_N_s_per_m * v) / model.mass_kg;
    x += v * time_s + 0.5 * a * time_s * time_s * (1 - rate / 3);
    v += a * time_s * (1 - rate / 2);
    return;
  }
  const double terminal = force_N / model.viscous_N_s_per_m;
  const double lost = -std::expm1(-rate);  // decayed share of the difference to terminal velocity
  x += terminal * time_s + (v - terminal) * lost * time_s / rate;
  v += (terminal - v) * lost;
}

double within(double force_N, double limit_N) {
  return std::isfinite(force_N) ? std::clamp(force_N, -limit_N, limit_N) : 0;
}

}  // namespace

void Axis::advance(const DeviceModel& model, double force_N, double time_s) {
  const double coulomb = model.coulomb_N;
  if (coulomb > 0 && !(std::fabs(velocity_mps) > 0)) {
    if (std::fabs(force_N) <= coulomb) return;  // sticks
    glide(model, force_N - std::copysign(coulomb, force_N), time_s, position_m, velocity_mps);
    return;
  }
  const double before = velocity_mps;
  const double start = position_m;
  const double friction = coulomb > 0 ? std::copysign(coulomb, before) : 0;
  glide(model, force_N - friction, time_s, position_m, velocity_mps);
  if (coulomb > 0 && before * velocity_mps < 0) {  // friction stopped the axis during `time_s`
    const double share = before / (before - velocity_mps);
    position_m = start + 0.5 * before * share * time_s;
    velocity_mps = 0;
  }
}

Device::Device(const DeviceModel& model, Vec start_m)
    : model_(model), queue_(model.output_delay_samples) {
  axis_[0].position_m = start_m.x;
  axis_[1].position_m = start_m.y;
  axis_[2].position_m = start_m.z;
}

Vec Device::limited(Vec motor_N) const {
  const double limit = model_.force_limit_N;
  return {within(motor_N.x, limit), within(motor_N.y, limit), within(motor_N.z, limit)};
}

void Device::command(Vec motor_N) {
  motor_N_ = limited(motor_N);
  if (queue_.empty()) return;
  std::swap(motor_N_, queue_[next_]);
  next_ = (next_ + 1) % queue_.size();
}

void Device::advance(Vec hand_N, double time_s) {
  axis_[0].advance(model_, motor_N_.x + hand_N.x, time_s);
  axis_[1].advance(model_, motor_N_.y + hand_N.y, time_s);
  axis_[2].advance(model_, motor_N_.z + hand_N.z, time_s);
}

int32_t Device::count(int axis) const {
  const double quanta = std::floor(axis_[axis].position_m / model_.encoder_quantum_m);
  return static_cast<int32_t>(std::clamp(quanta, -2147483647.0, 2147483647.0));
}

}  // namespace firmtouch::host_sim
