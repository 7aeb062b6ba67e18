#pragma once
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/servo/local_model.hpp"

// Force shading (Morgenbesser and Srinivasan 1996) of any shape: where a proxy falls over a convex
// edge its pull turns in one tick. Shaded, the spring's end stays behind the proxy, and follows by
// the way that the proxy goes, not by time: as on a round of radius s. Concave edges turn the pull
// with the hand already. They are not shaded, for there a lag would push the hand on.
//
// Energy of an edge of angle a, of a hand d deep before it, F = K d. The lag begins with d sin(a),
// across the new normal and against the way. A hand that
//     goes on    loses F s sin(a) tan(a) / 2, in a way of s tan(a), about F s a^2 / 2
//     turns back meets a spring whose end stands: it gets about K (d sin(a))^2 / 2, which the proxy
//                has lost in its fall from d to d cos(a)
// So a closed way over an edge gives the hand nothing. Over many edges at once, where s is far
// larger than the part, 7 uJ were found (tools/lab/JOURNAL.md); servo's account bounds what is
// left.
namespace firmtouch::scene {

/// State from tick to tick. The caller owns one a spring.
struct ForceShading {
  math::Vec3 proxy_m;  // device frame
  math::Vec3 pull_m;   // hand to proxy
  math::Vec3 aside_m;  // proxy to the spring's end
  float depth_m = 0;   // hand to proxy; 0: nothing is held
};

/// Moves the end of a spring that pulls to the proxy. `round_m`: s; 0: what is left of a lag goes
/// within a tenth of a millimetre. `carried_m`: by the object that the proxy is on, since the last
/// tick. A proxy that stands keeps its lag, less what the hand turns about it, and a lag fades
/// with the depth.
/// Bounds: constant; re-entrant for different states.
/// Result: the end is within the proxy's depth of the proxy.
void shade(float round_m, const math::Vec3& hand_m, const math::Vec3& carried_m, ForceShading& last,
           servo::ProxySpring& spring);

}  // namespace firmtouch::scene
