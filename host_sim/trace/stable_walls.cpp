#include "host_sim/trace/stable_walls.hpp"

#include "device/inertia.hpp"
#include "firmtouch/device/stable_wall.hpp"
#include "firmtouch/params/table.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {

StableWalls stable_walls(const Scenario& scenario, const Environment& environment) {
  const auto mass_kg = static_cast<float>(tools::least_figures(*scenario.linkage).least_mass_kg);
  const auto limit = [&](params::Index damping) {
    return static_cast<double>(device::stiffest_stable_N_per_m(
        mass_kg, static_cast<float>(parameter_value(scenario, damping)),
        static_cast<float>(parameter_value(scenario, params::kTickPeriod))));
  };
  const scene::Stiffening by = environment.stiffening();
  StableWalls walls;
  walls.contact_N_per_m = limit(params::kContactDamping) / static_cast<double>(by.share);
  walls.guide_N_per_m = limit(params::kGuideDamping);
  if (by.per_m > 0) walls.texture_N = limit(params::kDeviceDamping) / static_cast<double>(by.per_m);
  return walls;
}

}  // namespace firmtouch::host_sim
