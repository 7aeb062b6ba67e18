#pragma once
#include "firmtouch/scene/mesh_touched.hpp"
#include "firmtouch/scene/proxy_contact.hpp"
#include "firmtouch/scene/texture.hpp"

// Contact with a surface whose triangles are of several materials. scene/README.md says what
// happens where one changes under load.
namespace firmtouch::scene {

/// How one material responds to the tool, or the mean of several.
struct Response {
  float compliance_m_per_N = 0;  // 0: rigid
  float friction_static = 0, friction_dynamic = 0, friction_viscous_N_s_per_m = 0;
};

/// The force of a penetration d, less what a texture is cut, is stiffness (d - slack). Where a hand
/// under load slides onto another material no potential exists: the energy stored would jump. The
/// slack lets the stiffness change, so that the force makes no step and no energy is gained. Onto a
/// stiffer material the force rises by the root of their ratio, and further penetration meets all
/// of it. A texture that changes leaves a slack, too, below 0 where the new one is deeper.
struct ForceLaw {
  float stiffness_N_per_m = 0;
  float slack_m = 0;
  float left_J = 0;  // taken by changes of the law in this contact, less what they gave

  float at_N(float penetration_m) const;
  /// Goes towards a surface of `stiffness` at this penetration, by at most `step_N` of force.
  void approach(float stiffness, float penetration_m, float step_N);
};

/// State of a (tool, mesh) pair from tick to tick, beside its ProxyTouch. The caller owns one a
/// pair. A default one begins a contact.
struct MaterialTouch {
  ForceLaw law;
  Response response;     // friction in use
  bool is_held = false;  // the proxy was, at the end of the last tick
  uint8_t material = 0;  // that bears most of the load, else is nearest; 0: none
  // The material whose texture is in use, and the share of its height: under load it falls before
  // another one takes over.
  uint8_t textured = 0;
  float texture_share = 0;
  bool has_textures = false;  // the spring pulls to another place than the proxy
};

/// Before the proxy moves: the contact as the materials make it. Where it is loaded, after
/// end_materials() of the last tick.
void begin_materials(ProxyContact& contact, ProxyTouch& touch, const MaterialTouch& state);
/// After end_proxy_contact(): the model's spring has the stiffness of the materials touched, and
/// pulls to where their texture has it. `contact`: as it was before begin_materials().
void end_materials(const ProxyContact& contact, const MaterialMeshObject& object, ProxyTouch& touch,
                   MaterialTouch& state, servo::LocalModel& model);

/// touch_by_proxy() with a shape of `object`, whose features have materials; the same bits without
/// any. A stiffness is in series with that of `contact`, a friction the larger of both. Several
/// materials that hold the proxy count by their shares of the load; the texture is that of the
/// largest. Under load no change of materials makes a step of the force above 20 N/s, of textures
/// above 50 N/s, and all changes of a contact together give no energy.
/// Bounds: as touch_by_proxy(), and where materials change at most 1,000 instructions, with waves
/// 1,300 instructions, with a height map 1,600 instructions. Means: tests/host_sim/run_materials.
template <class Shape>
void touch_materials(const ProxyContact& contact, const MaterialMeshObject& object, Shape& shape,
                     ProxyTouch& touch, MaterialTouch& state, servo::LocalModel& model) {
  ProxyContact used = contact;
  const bool is_open = object.materials->is_open();
  if (is_open) begin_materials(used, touch, state);
  touch_by_proxy(used, shape, touch, model);
  if (is_open) end_materials(contact, object, touch, state, model);
}

}  // namespace firmtouch::scene
