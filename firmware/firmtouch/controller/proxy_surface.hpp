#pragma once
#include "firmtouch/controller/model.hpp"
#include "firmtouch/params/entry.hpp"
#include "firmtouch/scene/proxy_contact.hpp"

// What surface policies share that are touched through a proxy.
namespace firmtouch {

/// Settings of a tick's contact, from the parameters. `ticks`: since the last model.
scene::ProxyContact proxy_contact(const ModelRequest& request, uint32_t ticks,
                                  const params::Values& values);
/// Adds the proxy's last query to the record's part.
void report_proxy(const scene::ProxyTouch& touch, math::Vec3 hand_m, ModelResult& result);

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
