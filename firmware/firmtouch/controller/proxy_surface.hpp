#pragma once
#include "firmtouch/controller/model.hpp"
#include "firmtouch/params/entry.hpp"
#include "firmtouch/scene/proxy_contact.hpp"

// What surface policies share that are touched through a proxy.
namespace firmtouch {

/// Settings of a tick's contact, from the parameters.
scene::ProxyContact proxy_contact(const ModelRequest& request, const params::Values& values,
                                  const ModelResult& result);
/// Adds the proxy's last query to the record's part. `work`: units of all its queries.
void report_proxy(const scene::ProxyTouch& touch, math::Vec3 hand_m, uint32_t work,
                  ModelResult& result);

/// A shape that counts the work of its queries.
template <class Shape>
struct Counted {
  Shape shape;
  uint32_t work = 0;
  float size_m() const { return shape.size_m(); }
  scene::Near near(math::Vec3 x_m, query::Budget budget, float needed_m) {
    const scene::Near near = shape.near(x_m, budget, needed_m);
    work += near.work;
    return near;
  }
};

/// Contact with a shape in a tick.
template <class Shape>
void touch_shape(const Shape& shape, const ModelRequest& request, const params::Values& values,
                 scene::ProxyTouch& touch, ModelResult& result) {
  Counted<Shape> counted{shape};
  scene::touch_by_proxy(proxy_contact(request, values, result), counted, touch, result.model);
  report_proxy(touch, request.position_m, counted.work, result);
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
