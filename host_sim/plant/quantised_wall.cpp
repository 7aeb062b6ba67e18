// A wall on quantised positions with Coulomb friction: what describing functions predict, and what
// the simulated device does.
#include <cmath>

#include "host_sim/plant/device.hpp"
#include "host_sim/plant/sampled_wall.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr double kLongest_s = 60;

// Whether a motion below a quantum gains energy from the relay that the quantised wall is there:
// forces of +-h, h = K quantum / 2, T / 2 late on average. Gain and loss of a cycle of amplitude A:
// 4 h A sin(w T / 2) and pi b w A^2 + 4 f A; frequency: w^2 = 4 h / (pi m A).
bool relay_cycles(const QuantisedWall& w) {
  const double h = w.stiffness_N_per_m * w.quantum_m / 2, a = 0.1 * w.quantum_m;
  const double omega = std::sqrt(4 * h / (kPi * w.mass_kg * a));
  return 4 * h * std::sin(omega * w.period_s / 2) >
         kPi * w.viscous_N_s_per_m * omega * a + 4 * w.coulomb_N;
}

struct Outcome {
  bool grew = false, rests = false;
  double amplitude_m = 0;        // of the last fifth
  double half_period_ticks = 0;  // from one change of the force's sign to the next
};

Outcome swing(const QuantisedWall& w, double start_m) {
  DeviceModel model;
  model.mass_kg = w.mass_kg;
  model.viscous_N_s_per_m = w.viscous_N_s_per_m;
  model.coulomb_N = w.coulomb_N;
  model.encoder_quantum_m = w.quantum_m;
  model.force_limit_N = 1e300;
  Device device(model, {start_m, 0, 0});
  constexpr int kSubsteps = 16;
  const int ticks = static_cast<int>(kLongest_s / w.period_s), settled = ticks / 5 * 4;
  Outcome outcome;
  double low = 1, high = -1;
  int before = 0, changes = 0, first = 0, last = 0;
  for (int i = 0; i < ticks; ++i) {
    const int count = device.count(0);
    if (i > settled && (count < 0) != (before < 0)) {
      last = i;
      if (changes++ == 0) first = i;
    }
    before = count;
    device.command({-w.stiffness_N_per_m * w.quantum_m * (count + 0.5), 0, 0});
    for (int k = 0; k < kSubsteps; ++k) {
      device.advance({}, w.period_s / kSubsteps);
      if (i < settled) continue;
      low = std::fmin(low, device.position_m().x);
      high = std::fmax(high, device.position_m().x);
    }
    if (std::fabs(device.position_m().x) > 2 * start_m + 20 * w.quantum_m) {
      outcome.grew = true;
      return outcome;
    }
  }
  outcome.amplitude_m = (high - low) / 2;
  outcome.rests = !(high - low > 1e-3 * w.quantum_m);
  if (changes > 1) outcome.half_period_ticks = static_cast<double>(last - first) / (changes - 1);
  return outcome;
}

}  // namespace

Motion predicted_motion(const QuantisedWall& w) {
  const double gain_N_s_per_m = w.stiffness_N_per_m * w.period_s / 2 - w.viscous_N_s_per_m;
  if (gain_N_s_per_m < 0) return {relay_cycles(w) ? Regime::kCycle : Regime::kRest, 0, 0};
  if (relay_cycles(w)) return {Regime::kGrows, 0, 0};
  // pi (K T / 2 - b) w A^2 = 4 f A
  const double omega = std::sqrt(w.stiffness_N_per_m / w.mass_kg);
  return {Regime::kRests, 4 * w.coulomb_N / (kPi * omega * gain_N_s_per_m), 0};
}

// The force is +h for n periods, then -h. x_n = -x_0 and v_n = -v_0 give x_0 and v_0 exactly; each
// of the n samples must be below 0.
double cycle_amplitude_m(const QuantisedWall& w, double half_period_ticks) {
  const int n = static_cast<int>(std::lround(half_period_ticks));
  if (n < 1 || std::fabs(half_period_ticks - n) > 1e-3) return 0;
  const double tau_s = w.mass_kg / w.viscous_N_s_per_m;
  const double fast_mps = w.stiffness_N_per_m * w.quantum_m / 2 / w.viscous_N_s_per_m;  // h / b
  const double decay = std::exp(-n * w.period_s / tau_s);
  const double v0 = -fast_mps * (1 - decay) / (1 + decay);
  const auto moved = [&](double t) {
    return fast_mps * t - (v0 - fast_mps) * tau_s * std::expm1(-t / tau_s);
  };
  const double x0 = -moved(n * w.period_s) / 2;
  for (int i = 0; i < n; ++i)
    if (!(x0 + moved(i * w.period_s) < 0)) return 0;
  return -(x0 + moved(tau_s * std::log1p(-v0 / fast_mps)));
}

Motion simulated_motion(const QuantisedWall& w) {
  const Outcome near = swing(w, 0.7 * w.quantum_m), far = swing(w, 1000 * w.quantum_m);
  if (near.grew) return {Regime::kGrows, 0, 0};
  if (!far.grew) {
    if (near.rests && far.rests) return {};
    return {Regime::kCycle, far.amplitude_m, far.half_period_ticks};
  }
  double low = 0.7 * w.quantum_m, high = 1000 * w.quantum_m;
  while (high / low > 1.01) {
    const double middle = std::sqrt(low * high);
    (swing(w, middle).grew ? high : low) = middle;
  }
  return {Regime::kRests, std::sqrt(low * high), 0};
}

}  // namespace firmtouch::host_sim
