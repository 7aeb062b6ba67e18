#include "firmtouch/controller/shaded.hpp"

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch {

void shade(const ModelRequest& request, const params::Values& v, scene::ForceShading& last,
           ModelResult& result) {
  if (!request.has_proxy || !request.is_on) last.depth_m = 0;
  servo::ProxySpring& spring = result.model.spring;
  const float passed_s = v[params::kTickPeriod] * static_cast<float>(result.ticks);
  scene::shade(v[params::kContactShading], request.position_m, spring.velocity_mps * passed_s, last,
               spring);
}

}  // namespace firmtouch
