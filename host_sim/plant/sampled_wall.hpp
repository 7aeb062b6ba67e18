#pragma once
#include <cstdint>

#include "bench/estimators.hpp"

namespace firmtouch::host_sim {

/// One axis against a wall that is computed once a period, from the position of a tick:
///     F = -K x - B (x - x a tick ago) / T,    applied `delay_samples` later.
/// A hand may hold the axis: its mass moves with it, its damper and spring go to the ground.
struct SampledWall {
  double mass_kg = 0.075;
  double viscous_N_s_per_m = 0.5;
  double period_s = 1e-3;
  double damping_N_s_per_m = 0;  // B
  uint32_t delay_samples = 0;
  double hand_mass_kg = 0;
  double hand_damping_N_s_per_m = 0;
  double hand_stiffness_N_per_m = 0;
};

/// K below which the wall is passive: b > K T / 2 + |B| (Colgate & Schenkel 1994). 0: no K is.
double passive_limit_N_per_m(const SampledWall& wall);
/// K < (b + B) / (T / 2 + delay), for small B (Gil, Hulin & Diaz).
double delayed_limit_N_per_m(const SampledWall& wall);
/// K at which the spectral radius of the exact discrete model is 1: by the Schur-Cohn test of its
/// characteristic polynomial, and bisection.
double exact_limit_N_per_m(const SampledWall& wall);
/// Whether all roots of coefficient[0] z^degree + ... + coefficient[degree] are within the unit
/// circle (Schur-Cohn). Pre: degree < 16.
bool is_schur_stable(const double* coefficient, uint32_t degree);

/// K at which an excursion of the simulated device (plant/device.hpp) neither grows nor decays, by
/// bisection to 0.05 %.
double simulated_limit_N_per_m(const SampledWall& wall);

/// Stiffest wall at which the simulated axis, pushed with 1 N, comes to rest: less than three
/// quanta from peak to peak after 2.25 s. The position is the firmware's (device::read). By a rise
/// of 1 % until it does not. `of`: one that has seen no sample.
double rest_limit_N_per_m(const SampledWall& wall, double quantum_m,
                          const bench::NamedEstimate& of);

/// A wall on quantised positions, F = -K quantum (floor(x / quantum) + 1/2), and Coulomb friction.
struct QuantisedWall {
  double mass_kg = 0.1;
  double viscous_N_s_per_m = 0;
  double coulomb_N = 0;
  double period_s = 1e-3;
  double stiffness_N_per_m = 500;
  double quantum_m = 30e-6;
};

enum class Regime {
  kRest,   // it comes to rest from everywhere near
  kCycle,  // it keeps to a limit cycle of about a quantum
  kRests,  // it comes to rest from within an amplitude, and grows from beyond
  kGrows,  // it grows from everywhere
};

/// A regime. Of a cycle its amplitude (kRests: of the unstable one that parts rest from growth) and
/// its half period.
struct Motion {
  Regime regime = Regime::kRest;
  double amplitude_m = 0;
  double half_period_ticks = 0;
};

/// The regime by the energy of a cycle, with describing functions (Diolaiti and others 2006).
/// b > K T / 2: large motions decay. Friction of half a force step, K quantum / 2, holds the axis.
/// Result: with an amplitude for kRests only: stable cycles coexist, see below.
Motion predicted_motion(const QuantisedWall& wall);
/// Amplitude of the exact cycle below a quantum that is locked to so many samples a half period,
/// without friction. 0: there is none of that period.
double cycle_amplitude_m(const QuantisedWall& wall, double half_period_ticks);
Motion simulated_motion(const QuantisedWall& wall);

}  // namespace firmtouch::host_sim
