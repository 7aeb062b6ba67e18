#pragma once

namespace firmtouch::device {

/// The stiffest wall -K x - B v that is stable on a mass, where v is the difference of two
/// positions over the period, and `damping_N_s_per_m` is B and what the mass has of its own. With
/// D of it and d = D T / (2 m): 2 D / T (1 - d) / (1 + d), by Jury's test of the exact discrete
/// model; 0 from d = 1 on.
/// Pre: mass and period are above 0, the damping is at least 0. Result: finite.
/// Error: exact where the mass has no friction of its own. Friction holds more than a damper of the
/// wall: where it is half of D the wall is at most 1.2 d too low, and never too high
/// (tests/host_sim/z_width_host_test.cpp).
float stiffest_stable_N_per_m(float mass_kg, float damping_N_s_per_m, float period_s);

}  // namespace firmtouch::device
