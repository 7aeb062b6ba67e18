#include "firmtouch/servo/force_parts.hpp"

#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "firmtouch/servo/proxy_spring.hpp"

namespace firmtouch::servo {

using math::Vec3;

Vec3 contact_N(const LocalModel& model, Vec3 position_m, Vec3 velocity_mps) {
  LocalModel planes;
  planes.plane_count = model.plane_count;
  for (uint32_t i = 0; i < model.plane_count; ++i) planes.plane[i] = model.plane[i];
  const ProxySpring& spring = model.spring;
  return evaluate(planes, position_m, velocity_mps) + spring_N(spring, proxy_at(spring, position_m),
                                                               FLT_MAX, position_m,
                                                               velocity_mps - spring.velocity_mps);
}

Vec3 guide_N(const LocalModel& model, Vec3 position_m, Vec3 velocity_mps) {
  LocalModel line;
  line.guide = model.guide;
  line.has_guide = model.has_guide;
  return evaluate(line, position_m, velocity_mps);
}

}  // namespace firmtouch::servo
