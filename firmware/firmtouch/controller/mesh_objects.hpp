#pragma once
#include <stdint.h>

#include "firmtouch/controller/first_of.hpp"
#include "firmtouch/controller/model.hpp"
#include "firmtouch/controller/needed_parts.hpp"
#include "firmtouch/mesh/hint.hpp"
#include "firmtouch/mesh/loader.hpp"
#include "firmtouch/params/compose.hpp"
#include "firmtouch/params/rows.hpp"
#include "firmtouch/scene/objects.hpp"
#include "firmtouch/scene/stored_objects.hpp"

namespace firmtouch {

constexpr uint32_t kMaxObjectMeshes = 8;

/// A surface policy: the objects of an asset (scene/objects_layout.hpp), up to 16 of up to 8
/// meshes, each with a pose, a twist and a material. The tool touches the nearest ones. They stand
/// until a command moves them. Distance fields and base hulls of the meshes are not used.
/// Stiffness is in series with contact_stiffness, friction the larger of the object's and the
/// parameters'.
class MeshObjects : public MovingSurface {
 public:
  using Parameters = params::Groups<params::ContactRows, params::FrictionRows>;
  using State = mesh::Loader::State;
  static constexpr bool kIsGuide = false;
  static constexpr uint32_t kParts = kPartMesh | kPartObjects;

  static const char* find(const asset::Container& asset, const char* wanted) {
    return asset::find_name(asset, scene::kObjectsSection, wanted);
  }
  void close();
  template <class Trust>
  void begin(const asset::Container& asset, const char* name, State&) {
    close();
    asset_ = &asset;
    name_ = name;
  }
  template <class Trust>
  asset::Progress work(State& state, uint32_t units);

  bool is_open() const { return mesh_count_ > 0 && at_ == mesh_count_; }
  /// Objects are where the asset has them, and stand.
  void reset();
  /// record::kCommandMoveObject: from now on the object moves by its twist times `speed`.
  /// Result: false if there is no such object, or the speed is not -1 to 1.
  bool take_command(uint32_t command, float speed);
  /// Moves all objects for a tick.
  void advance(float passed_s);
  void touch(const ModelRequest& request, const params::Values& values, ModelResult& result);

  // Pre of what follows: is_open(), i < stored().size().
  const scene::StoredObjects& stored() const { return stored_; }
  const mesh::View& mesh(uint32_t i) const { return mesh_[mesh_of_[i]].view(); }
  /// Device frame.
  const scene::Object& object(uint32_t i) const { return object_[i]; }
  /// Of the last model.
  const scene::ObjectsTouch& contact() const { return touch_; }
  /// Largest distance that the objects have had from each other: what tolerances refer to.
  float size_m() const { return size_m_; }

 private:
  struct Shapes;

  core::Verdict read_section();
  core::Verdict find_mesh(uint32_t object);
  const char* mesh_name(uint32_t mesh) const { return stored_[first_of_[mesh]].mesh; }
  void place(math::Vec3 origin_m);
  void make_room(uint32_t object);

  const asset::Container* asset_ = nullptr;
  const char* name_ = nullptr;
  scene::StoredObjects stored_;
  mesh::Loader mesh_[kMaxObjectMeshes];
  uint8_t first_of_[kMaxObjectMeshes] = {};   // the first object of each mesh
  uint8_t mesh_of_[scene::kMaxObjects] = {};  // of each object
  uint8_t mesh_count_ = 0, at_ = 0;           // meshes, and how many are open
  bool is_begun_ = false;
  scene::Object object_[scene::kMaxObjects];
  float speed_[scene::kMaxObjects] = {};  // times the twist
  scene::ObjectPair pair_[scene::kMaxObjects];
  mesh::Hint hint_[scene::kMaxObjects];
  math::Vec3 origin_m_;  // of the scene
  float size_m_ = 0;
  scene::ObjectsTouch touch_;
};

template <class Trust>
asset::Progress MeshObjects::work(State& state, uint32_t units) {
  if (mesh_count_ == 0) {
    const core::Verdict verdict = read_section();
    return {!verdict.ok(), verdict};
  }
  mesh::Loader& loader = mesh_[at_];
  if (!is_begun_) {
    loader.begin<Trust>(*asset_, mesh_name(at_), state);
    is_begun_ = true;
    return {};
  }
  const asset::Progress progress = loader.work<Trust>(state, units);
  if (!progress.is_done || !progress.verdict.ok()) return progress;
  is_begun_ = false;
  ++at_;
  if (is_open()) place({});
  return {is_open(), core::kPassed};
}

}  // namespace firmtouch
