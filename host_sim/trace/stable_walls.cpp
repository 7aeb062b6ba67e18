#include "host_sim/trace/stable_walls.hpp"

#include <algorithm>

#include "device/inertia.hpp"
#include "firmtouch/device/stable_wall.hpp"
#include "firmtouch/params/table.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {

StableWalls stable_walls(const Scenario& scenario, const Environment& environment) {
  const auto mass_kg = static_cast<float>(tools::least_figures(*scenario.linkage).least_mass_kg);
  const auto value = [&](params::Index row) {
    return static_cast<float>(parameter_value(scenario, row));
  };
  const auto limit = [&](float damping_N_s_per_m) {
    return static_cast<double>(
        device::stiffest_stable_N_per_m(mass_kg, damping_N_s_per_m, value(params::kTickPeriod)));
  };
  const float contact_N_s_per_m = value(params::kContactDamping);
  const float guide_N_s_per_m = value(params::kGuideDamping);
  const scene::Stiffening by = environment.stiffening();
  StableWalls walls;
  walls.contact_N_per_m = limit(contact_N_s_per_m) / static_cast<double>(by.share);
  walls.guide_N_per_m = limit(guide_N_s_per_m);
  walls.both_N_per_m = limit(contact_N_s_per_m + guide_N_s_per_m) / static_cast<double>(by.share);
  walls.contact_beside_guide_N_per_m =
      std::clamp(limit(contact_N_s_per_m + guide_N_s_per_m) -
                     static_cast<double>(value(params::kGuideStiffness)),
                 0.0, limit(contact_N_s_per_m)) /
      static_cast<double>(by.share);
  if (by.per_m > 0)
    walls.texture_N = limit(value(params::kDeviceDamping)) / static_cast<double>(by.per_m);
  return walls;
}

}  // namespace firmtouch::host_sim
