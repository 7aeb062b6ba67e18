#pragma once
#include <stdint.h>

#include "firmtouch/controller/loaders.hpp"
#include "firmtouch/controller/model.hpp"
#include "firmtouch/controller/needed_parts.hpp"
#include "firmtouch/controller/proxy_surface.hpp"
#include "firmtouch/field/loader.hpp"
#include "firmtouch/hull/loader.hpp"
#include "firmtouch/mesh/loader.hpp"
#include "firmtouch/params/compose.hpp"
#include "firmtouch/params/rows.hpp"
#include "firmtouch/scene/mesh_contact.hpp"

namespace firmtouch {

/// What the surfaces of meshes share: the state of the (tool, mesh) pair.
class MeshContact {
 public:
  using Parameters = params::Groups<params::ContactRows, params::FrictionRows>;
  using PenaltyTouch = scene::MeshTouch;
  static constexpr bool kIsGuide = false;

  void reset() {
    touch_ = {};
    hint_ = {};
  }
  /// Of the last model; unused under penalty contact.
  const SurfaceTouch& contact() const { return touch_; }

 protected:
  SurfaceTouch touch_;
  mesh::Hint hint_;
};

/// A surface policy: a mesh and, if the asset has them, what the further loaders load of it: a
/// distance field, a hull.
template <class... Others>
class MeshWith : public MeshContact, public LoaderChain<mesh::Loader, Others...> {
 protected:
  static constexpr bool kHasField = (__is_base_of(field::Loader, Others) || ...);
  static constexpr bool kHasHull = (__is_base_of(hull::Loader, Others) || ...);

 public:
  static constexpr uint32_t kParts =
      kPartMesh | (kHasField ? uint32_t{kPartField} : 0u) | (kHasHull ? uint32_t{kPartHull} : 0u);

  MeshWith() {
    if constexpr (kHasField) this->template get<field::Loader>().prove_against(mesh());
  }
  const mesh::View& mesh() const { return this->template get<mesh::Loader>().view(); }
  template <class Loader = field::Loader>
  const field::View& distance_field() const {
    return this->template get<Loader>().view();
  }
  template <class Loader = hull::Loader>
  const hull::View& hull() const {
    return this->template get<Loader>().view();
  }
  bool is_open() const { return mesh().is_open(); }
  void touch(const ModelRequest& request, const params::Values& values, ModelResult& result);
  void touch_by_penalty(const ModelRequest& request, const params::Values& values,
                        PenaltyTouch& touch, ModelResult& result) const;

 protected:
  template <class Object>
  Object object(const ModelRequest& request, const params::Values& values) const;
};

template <class... Others>
template <class Object>
Object MeshWith<Others...>::object(const ModelRequest& request, const params::Values& v) const {
  Object object;
  object.mesh = &mesh();
  object.pose.translation_m = scene_origin_m(request, v);
  object.material = {v[params::kContactStiffness], v[params::kContactDamping]};
  if constexpr (kHasField) object.distance_field = &distance_field();
  if constexpr (kHasHull) object.base_hull = &hull().base_hull();
  return object;
}

using MeshSurface = MeshWith<>;
using FieldMesh = MeshWith<field::Loader>;
using HulledMesh = MeshWith<hull::Loader>;
using FullMesh = MeshWith<field::Loader, hull::Loader>;

extern template class MeshWith<>;
extern template class MeshWith<field::Loader>;
extern template class MeshWith<hull::Loader>;
extern template class MeshWith<field::Loader, hull::Loader>;

}  // namespace firmtouch
