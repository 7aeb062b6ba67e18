#include "host_sim/report/held_proxy.hpp"

#include "firmtouch/math/vec3_ops.hpp"

namespace firmtouch::host_sim {
namespace {

// `rotation`: of the frame that the proxy is in.
HeldProxy held_by(const scene::Proxy& proxy, const math::Mat3& rotation) {
  HeldProxy held;
  held.kind = proxy.phase == scene::Proxy::Phase::kInside ? 'i' : '0';
  if (proxy.phase != scene::Proxy::Phase::kFree || !proxy.is_loaded) return held;
  for (uint32_t n = 0; n < 3 && n < proxy.active.count; ++n)
    if (proxy.active.plane[n] < proxy.feature_count)
      held.normals.push_back(tools::to_point(rotation * proxy.plane[proxy.active.plane[n]].normal));
  held.kind = static_cast<char>('0' + held.normals.size());
  return held;
}

}  // namespace

HeldProxy HeldProxies::read(Vec tool_m) const {
  const ToolController& controller = *session_.controller;
  HeldProxy held;
  float at_rest = 0, sliding = 0;  // of what is touched
  if (controller.tool().is_open()) {
    const scene::ToolTouch& touch = controller.tool().contact();
    const scene::Proxy& proxy = touch.sphere[touch.nearest].proxy;
    held = held_by(proxy, {});
    held.proxy_m = tool_m + tools::to_point(proxy.position_m - touch.place_m[touch.nearest]);
  } else if (controller.objects().is_open()) {
    const MeshObjects& objects = controller.objects();
    const scene::ObjectsTouch& touch = objects.contact();
    scene::Object object;
    if (touch.carrier < objects.stored().size()) object = objects.object(touch.carrier);
    held = held_by(touch.touch.proxy, object.pose.rotation);
    held.proxy_m = tools::to_point(touch.anchor_m);
    at_rest = object.friction_static, sliding = object.friction_dynamic;
  } else {
    const auto& mesh = controller.surface<FullMaterialMesh>();
    const scene::Proxy& proxy =
        (mesh.is_open() ? mesh.contact() : controller.surface<SplineSurface>().contact()).proxy;
    held = held_by(proxy, {});
    held.proxy_m = tools::to_point(proxy.position_m);
    at_rest = mesh.touched().response.friction_static;
    sliding = mesh.touched().response.friction_dynamic;
  }
  const params::Values& values = controller.values();
  held.friction_static = static_cast<double>(std::max(at_rest, values[params::kFrictionStatic]));
  held.friction_dynamic = static_cast<double>(std::max(sliding, values[params::kFrictionDynamic]));
  return held;
}

HeldProxy HeldProxies::after(const record::TickRecord& record) {
  const Vec tool_m = wide(record.output.position_m);
  if (session_.penalty != nullptr) {
    used_.kind = 'p';
  } else if ((record.input.flags & record::kFlagModelApart) == 0) {
    used_ = read(tool_m);
  } else {
    if ((record.input.flags & record::kFlagModelTaken) != 0) used_ = made_;
    if ((record.input.flags & record::kFlagModelWanted) != 0) made_ = read(tool_m);
  }
  if ((record.output.state & record::kStateContact) == 0) return {};
  used_.hand_m = tool_m - used_.proxy_m;
  return used_;
}

}  // namespace firmtouch::host_sim
