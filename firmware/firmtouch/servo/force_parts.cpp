#include "firmtouch/servo/force_parts.hpp"

#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/servo/evaluate.hpp"
#include "firmtouch/servo/guide_line.hpp"
#include "firmtouch/servo/proxy_spring.hpp"

namespace firmtouch::servo {

using math::Vec3;

Vec3 contact_N(const LocalModel& model, Vec3 position_m, Vec3 velocity_mps) {
  const ProxySpring& spring = model.spring;
  return planes_N(model, position_m, velocity_mps) + spring_N(spring, proxy_at(spring, position_m),
                                                              FLT_MAX, position_m,
                                                              velocity_mps - spring.velocity_mps);
}

Vec3 guide_N(const LocalModel& model, Vec3 position_m, Vec3 velocity_mps) {
  if (!model.has_guide) return {};
  return pull_N(model.guide, guided_off_m(model.guide, position_m), velocity_mps, 1.0f) +
         drive_N(model.guide, position_m, velocity_mps);
}

}  // namespace firmtouch::servo
