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

/// What the surfaces of meshes share: the state of the (tool, mesh) pair, and the object.
class MeshContact {
 public:
  using Parameters = params::Groups<params::ContactRows, params::FrictionRows>;
  using PenaltyTouch = scene::MeshTouch;
  static constexpr bool kIsGuide = false;

  void reset() {
    touch_ = {};
    hint_ = {};
  }

 protected:
  scene::MeshObject object(const mesh::View& mesh, const params::Values& values) const;

  scene::ProxyTouch touch_;
  mesh::Hint hint_;
};

/// A surface policy: a mesh alone.
class MeshSurface : public MeshContact, public mesh::Loader {
 public:
  static constexpr uint32_t kParts = kPartMesh;
  const mesh::View& mesh() const { return view(); }
  bool is_open() const { return mesh().is_open(); }
  void touch(const ModelRequest& request, const params::Values& values, ModelResult& result);
  void touch_by_penalty(const ModelRequest& request, const params::Values& values,
                        PenaltyTouch& touch, ModelResult& result) const;
};

/// A mesh with its distance field, if the asset has one.
class FieldMesh : public MeshContact, public LoaderChain<mesh::Loader, field::Loader> {
 public:
  static constexpr uint32_t kParts = kPartMesh | kPartField;
  FieldMesh() { get<field::Loader>().prove_against(mesh()); }
  const mesh::View& mesh() const { return get<mesh::Loader>().view(); }
  const field::View& distance_field() const { return get<field::Loader>().view(); }
  bool is_open() const { return mesh().is_open(); }
  void touch(const ModelRequest& request, const params::Values& values, ModelResult& result);
  void touch_by_penalty(const ModelRequest& request, const params::Values& values,
                        PenaltyTouch& touch, ModelResult& result) const;
};

/// A mesh with its base hull, if the asset has one.
class HulledMesh : public MeshContact, public LoaderChain<mesh::Loader, hull::Loader> {
 public:
  static constexpr uint32_t kParts = kPartMesh | kPartHull;
  const mesh::View& mesh() const { return get<mesh::Loader>().view(); }
  const hull::View& hull() const { return get<hull::Loader>().view(); }
  bool is_open() const { return mesh().is_open(); }
  void touch(const ModelRequest& request, const params::Values& values, ModelResult& result);
  void touch_by_penalty(const ModelRequest& request, const params::Values& values,
                        PenaltyTouch& touch, ModelResult& result) const;
};

/// A mesh with its distance field and its base hull, if the asset has them.
class FullMesh : public MeshContact, public LoaderChain<mesh::Loader, field::Loader, hull::Loader> {
 public:
  static constexpr uint32_t kParts = kPartMesh | kPartField | kPartHull;
  FullMesh() { get<field::Loader>().prove_against(mesh()); }
  const mesh::View& mesh() const { return get<mesh::Loader>().view(); }
  const field::View& distance_field() const { return get<field::Loader>().view(); }
  const hull::View& hull() const { return get<hull::Loader>().view(); }
  bool is_open() const { return mesh().is_open(); }
  void touch(const ModelRequest& request, const params::Values& values, ModelResult& result);
  void touch_by_penalty(const ModelRequest& request, const params::Values& values,
                        PenaltyTouch& touch, ModelResult& result) const;
};

}  // namespace firmtouch
