#include "firmtouch/controller/proxy_surface.hpp"

#include "firmtouch/scene/pose_loss.hpp"

namespace firmtouch {

scene::ProxyContact proxy_contact(const ModelRequest& request, const params::Values& v,
                                  const ModelResult& result) {
  // Friction's slide and share and the growth follow from the rest: begin_proxy_contact().
  return {{v[params::kToolRadius], v[params::kFrictionStatic], v[params::kFrictionDynamic], 0, 0, 0,
           0, work_budget(v, params::kMeshWork, result)},
          {v[params::kContactStiffness], v[params::kContactDamping]},
          request.position_m,
          request.proxy_m,
          request.has_proxy,
          request.is_on,
          v[params::kTickPeriod] * static_cast<float>(result.ticks),
          v[params::kFrictionSpeed],
          v[params::kFrictionViscous]};
}

void use_origin(math::Vec3 origin_m, SurfaceTouch& touch) {
  if (scene::is_same(origin_m, touch.origin_m)) return;
  touch.origin_m = origin_m;
  touch.proxy.phase = scene::Proxy::Phase::kUnknown;
  touch.proxy.is_loaded = false;
  touch.proxy.searched_free_m = 0;
}

void report_proxy(const scene::ProxyTouch& touch, math::Vec3 hand_m, ModelResult& result) {
  const scene::Proxy& proxy = touch.proxy;
  const scene::Bounds bounds = scene::bounds_of(proxy, hand_m);
  const query::Certificate certificate{bounds.lower_m, touch.moved.steps, proxy.near.is_exact,
                                       proxy.near.sign, touch.moved.work};
  report_surface(certificate, proxy.near.sign < 0 ? -bounds.upper_m : bounds.upper_m,
                 touch.penetration_m, result);
  result.state |= record::kStateProxy;
  if (touch.moved.is_of_base_hull) result.state |= record::kStateOfBaseHull;
}

}  // namespace firmtouch
