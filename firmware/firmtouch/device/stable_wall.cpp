#include "firmtouch/device/stable_wall.hpp"

namespace firmtouch::device {

float stiffest_stable_N_per_m(float mass_kg, float damping_N_s_per_m, float period_s) {
  const float share = 0.5f * damping_N_s_per_m * period_s / mass_kg;
  if (!(share < 1.0f)) return 0;
  return 2.0f * damping_N_s_per_m / period_s * (1.0f - share) / (1.0f + share);
}

}  // namespace firmtouch::device
