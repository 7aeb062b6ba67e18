#include "firmtouch/controller/objects_controller.hpp"
#include "host_sim/plant/environment.hpp"

namespace firmtouch::host_sim {

Environment environment_of(const ObjectsController& controller, Vec origin_m) {
  std::vector<Vec> guide;
  if (controller.curve().is_open())
    for (const curve::Sample& s : controller.curve().samples())
      guide.push_back(
          {static_cast<double>(s.x_m), static_cast<double>(s.y_m), static_cast<double>(s.z_m)});
  constexpr int kPoints = 2000;
  if (guide.empty() && controller.spline_guide().is_open())
    for (int i = 0; i <= kPoints; ++i) {
      const math::Vec3 p = spline::point_at_arc(
          controller.spline_guide(), static_cast<float>(i) / static_cast<float>(kPoints));
      guide.push_back(
          {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)});
    }
  // Makes the last point equal to the first in every bit, so that the guide counts as closed.
  const bool is_closed = controller.spline_guide().is_open() && !controller.curve().is_open() &&
                         controller.spline_guide().chains().size() == 1 &&
                         controller.spline_guide().chains()[0].is_closed != 0;
  if (is_closed) guide.back() = guide.front();
  return {controller.mesh(), controller.spline_surface(), std::move(guide), origin_m};
}

}  // namespace firmtouch::host_sim
