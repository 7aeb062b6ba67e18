#pragma once
#include "firmtouch/controller/model.hpp"
#include "firmtouch/params/compose.hpp"
#include "firmtouch/params/rows.hpp"
#include "firmtouch/scene/force_shading.hpp"

namespace firmtouch {

/// Shades the spring of a model that is made.
void shade(const ModelRequest& request, const params::Values& values, scene::ForceShading& last,
           ModelResult& result);

/// A list of surfaces whose force turns over convex edges as contact_shading_m says:
/// Controller<Shaded<Surfaces<MeshSurface>>>. At 0 the same bits as without. The record's proxy_m
/// is where the spring ends; distances are those of the proxy.
template <class SurfaceList>
class Shaded : public SurfaceList {
 public:
  using Parameters =
      params::Joined<typename SurfaceList::Parameters, params::Groups<params::ShadingRows>>;

  void reset() {
    SurfaceList::reset();
    shading_ = {};
  }
  void touch(const ModelRequest& request, const params::Values& values, ModelResult& result) {
    SurfaceList::touch(request, values, result);
    if (values[params::kContactShading] > 0.0f || shading_.depth_m > 0.0f)
      shade(request, values, shading_, result);
  }

 private:
  scene::ForceShading shading_;
};

}  // namespace firmtouch
