#pragma once
#include "firmtouch/controller/model.hpp"
#include "firmtouch/params/entry.hpp"
#include "firmtouch/scene/proxy_contact.hpp"

// What surface policies share that are touched through a proxy.
namespace firmtouch {

/// Settings of a tick's contact, from the parameters.
scene::ProxyContact proxy_contact(const ModelRequest& request, const params::Values& values,
                                  const ModelResult& result);
/// Adds what the proxy has done to the record's part.
void report_proxy(const scene::ProxyTouch& touch, math::Vec3 hand_m, ModelResult& result);

/// Contact of a surface policy.
struct SurfaceTouch : scene::ProxyTouch {
  math::Vec3 origin_m;  // of the scene that it is with
};

/// Contact begins anew where the scene was moved: nothing that was certified holds there.
void use_origin(math::Vec3 origin_m, SurfaceTouch& touch);

/// Contact with a shape in a tick. `shape.object` has its pose.
template <class Shape>
void touch_shape(Shape shape, const ModelRequest& request, const params::Values& values,
                 SurfaceTouch& touch, ModelResult& result) {
  use_origin(shape.object.pose.translation_m, touch);
  scene::touch_by_proxy(proxy_contact(request, values, result), shape, touch, result.model);
  report_proxy(touch, request.position_m, result);
}

/// A surface policy with penalty contact instead of a proxy, for comparison:
/// Controller<Surfaces<Penalty<MeshSurface>>>.
template <class Surface>
class Penalty : public Surface {
 public:
  void reset() {
    Surface::reset();
    touch_ = {};
  }
  void touch(const ModelRequest& request, const params::Values& values, ModelResult& result) {
    this->touch_by_penalty(request, values, touch_, result);
  }

 private:
  typename Surface::PenaltyTouch touch_;
};

}  // namespace firmtouch
