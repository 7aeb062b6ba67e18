#include "firmtouch/controller.hpp"
#include "host_sim/world.hpp"

namespace firmtouch::host_sim {

World world_of(const Controller& controller, Vec origin_m) {
  std::vector<Vec> guide;
  if (controller.curve().is_open())
    for (const curve::Sample& s : controller.curve().samples())
      guide.push_back(
          {static_cast<double>(s.x_m), static_cast<double>(s.y_m), static_cast<double>(s.z_m)});
  return {controller.mesh(), std::move(guide), origin_m};
}

}  // namespace firmtouch::host_sim
