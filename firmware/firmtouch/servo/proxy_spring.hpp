#pragma once
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/servo/local_model.hpp"

namespace firmtouch::servo {

/// Where the proxy is for a tool at `position_m` (device frame): at the anchor where a surface
/// holds it, else at the tool, or as near to it as the model's reach allows. Without a proxy: the
/// tool's position.
/// Result: within reach of the anchor; at the anchor for a position with NaN.
math::Vec3 proxy_at(const ProxySpring& spring, math::Vec3 position_m);

/// Force of the spring from the tool to the proxy at `proxy_m`, stretched by at most `stretch_m`,
/// with a damper that never pushes the tool away from it.
/// Pre: as evaluate(). Result: finite.
math::Vec3 spring_N(const ProxySpring& spring, math::Vec3 proxy_m, float stretch_m,
                    math::Vec3 position_m, math::Vec3 velocity_mps);

}  // namespace firmtouch::servo
