#include "firmtouch/scene/material_touch.hpp"

#include <float.h>

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/scene/texture_pull.hpp"

namespace firmtouch::scene {
namespace {

using math::larger;
using math::smaller;

// Rounding of a change must not gain energy.
constexpr float kLess = 1.0f - 0x1p-21f;
constexpr float kMaxChange_N_per_s = 20.0f;  // of the force, by a change of material

// A working set may hold any bits: one that is in no table counts as none.
void add(const StoredMaterials& materials, uint8_t number, float weight, Response& sum) {
  if (number == 0 || number > materials.table().size()) return;
  const MaterialLayout& material = materials.table()[number - 1u];
  sum.compliance_m_per_N += weight / material.stiffness_N_per_m;
  sum.friction_static += weight * material.friction_static;
  sum.friction_dynamic += weight * material.friction_dynamic;
  sum.friction_viscous_N_s_per_m += weight * material.friction_viscous_N_s_per_m;
}

// Of a proxy without load: the feature whose plane is nearest.
uint8_t nearest_material(const Proxy& proxy) {
  const math::Vec3 at_m = proxy.position_m - proxy.planes_at_m;
  float least_m = FLT_MAX;
  uint8_t material = 0;
  for (uint32_t i = 0; i < proxy.feature_count && i < kMaxFeatures; ++i) {
    const float left_m = math::dot(proxy.plane[i].normal, at_m) - proxy.plane[i].offset_m;
    if (left_m < least_m) least_m = left_m, material = proxy.feature[i].material;
  }
  return material;
}

// Of those that hold the proxy, by their shares of the load. What stands for the mesh while the
// work does not suffice has no material.
// Result: false if none has.
bool mean_of_active(const Proxy& proxy, math::Vec3 pull_m, const StoredMaterials& materials,
                    Response& mean, uint8_t& most) {
  Response sum;
  float load_m = 0, most_m = 0;
  for (uint32_t n = 0; n < 3 && n < proxy.active.count; ++n) {
    const uint32_t i = proxy.active.plane[n];
    if (i >= proxy.feature_count || proxy.feature[i].is_of_base_hull) continue;
    const float push_m = math::dot(proxy.plane[i].normal, pull_m);
    if (!(push_m > 0.0f)) continue;
    const uint8_t material = proxy.feature[i].material;
    load_m += push_m;
    if (push_m > most_m) most_m = push_m, most = material;
    add(materials, material, push_m, sum);
  }
  if (!(load_m > 0.0f)) return false;
  const float share = 1.0f / load_m;
  mean = {sum.compliance_m_per_N * share, sum.friction_static * share, sum.friction_dynamic * share,
          sum.friction_viscous_N_s_per_m * share};
  return true;
}

// Under a force `load_N` a friction that falls lets it fall by at most `step_N`: Coulomb friction
// is at most its coefficient times the force, viscous friction at most the force.
void follow(const Response& wanted, float load_N, float step_N, Response& response) {
  const float share = step_N < load_N ? step_N / load_N : 1.0f;
  const float coulomb = step_N < load_N ? share : FLT_MAX;
  response.friction_static = larger(wanted.friction_static, response.friction_static - coulomb);
  response.friction_dynamic = larger(wanted.friction_dynamic, response.friction_dynamic - coulomb);
  response.friction_viscous_N_s_per_m = larger(
      wanted.friction_viscous_N_s_per_m, response.friction_viscous_N_s_per_m * (1.0f - share));
}

// What the texture in use takes off.
Cut cut_of(const StoredMaterials& materials, const MaterialTouch& state, math::Vec3 x_m) {
  const Cut whole = materials.cut_of(state.textured, x_m);
  return {whole.depth_m * state.texture_share, whole.slope * state.texture_share};
}

// Where the material has changed, its texture takes over from the one before. A slack keeps the
// energy, and so the force; its direction turns by the slope, at most 0.75, times `share`.
void change_texture(const StoredMaterials& materials, math::Vec3 x_m, float share,
                    MaterialTouch& state, Cut& cut) {
  const bool is_own = state.textured == state.material;
  if (is_own && state.texture_share >= 1.0f) return;
  const float before_m = cut.depth_m;
  state.texture_share += is_own ? share : -share;
  if (state.texture_share > 1.0f) state.texture_share = 1.0f;
  if (!(state.texture_share > 0.0f)) state.texture_share = 0.0f, state.textured = state.material;
  cut = cut_of(materials, state, x_m);
  state.law.slack_m += before_m - cut.depth_m;
}

}  // namespace

float ForceLaw::at_N(float penetration_m) const {
  return penetration_m > slack_m ? stiffness_N_per_m * (penetration_m - slack_m) : 0.0f;
}

// At this penetration d the force F may be kept by any spring of stretch s <= d, which stores F s /
// 2. The one nearest to the material's own, s = d, is taken that stores no more than this one and
// what is left. A force that is too small may rise where enough is left.
void ForceLaw::approach(float stiffness, float penetration_m, float step_N) {
  const bool is_same = !(stiffness > stiffness_N_per_m) && !(stiffness < stiffness_N_per_m);
  if (is_same && !(slack_m < 0.0f) && !(slack_m > 0.0f && left_J > 0.0f)) return;
  const float most_N_per_m = larger(stiffness, stiffness_N_per_m);
  const float is_N = at_N(penetration_m), own_N = stiffness * penetration_m;
  const float stored_J = 0.5f * is_N * larger(penetration_m - slack_m, 0.0f);
  const float has_J = (stored_J + left_J) * kLess;
  float to_N = larger(larger(own_N, is_N - step_N), 0.0f);
  if (own_N > is_N) {
    const float paid_N = math::square_root(2.0f * stiffness * has_J);
    to_N = larger(smaller(paid_N, smaller(own_N, is_N + step_N)), is_N);
  }
  float stretch_m = penetration_m;
  if (stiffness * stretch_m > to_N) stretch_m = to_N / stiffness;
  if (to_N * stretch_m > 2.0f * has_J) stretch_m = 2.0f * has_J / to_N;
  if (slack_m < 0.0f && to_N > most_N_per_m * stretch_m) stretch_m = to_N / most_N_per_m;
  slack_m = penetration_m - stretch_m;
  stiffness_N_per_m = stretch_m > 0.0f ? smaller(to_N / stretch_m, most_N_per_m) : stiffness;
  left_J = larger(has_J - 0.5f * to_N * stretch_m, 0.0f);
}

void begin_materials(ProxyContact& contact, ProxyTouch& touch, const MaterialTouch& state) {
  const Response& response = state.response;
  ProxySettings& settings = contact.settings;
  settings.friction_static = larger(settings.friction_static, response.friction_static);
  settings.friction_dynamic = larger(settings.friction_dynamic, response.friction_dynamic);
  contact.friction_viscous_N_s_per_m =
      larger(contact.friction_viscous_N_s_per_m, response.friction_viscous_N_s_per_m);
  // A spring to another place than the proxy held it in the model before the last.
  const Proxy& proxy = touch.proxy;
  const float reach_m = proxy.free_m - proxy.radius_m;
  if (state.has_textures && !(math::length(contact.proxy_m - proxy.position_m) <= reach_m))
    contact.proxy_m = proxy.position_m;
  if (!state.is_held) return;
  contact.material.stiffness_N_per_m = state.law.stiffness_N_per_m;
  touch.material = contact.material;
}

void end_materials(const ProxyContact& contact, const MaterialMeshObject& object, ProxyTouch& touch,
                   MaterialTouch& state, servo::LocalModel& model) {
  const Proxy& proxy = touch.proxy;
  const StoredMaterials& materials = *object.materials;
  const float tool_N_per_m = contact.material.stiffness_N_per_m;
  const bool was_held = state.is_held, has_textures = materials.has_textures();
  state.is_held = model.spring.is_used && proxy.is_loaded && touch.penetration_m > 0.0f;
  if (!state.is_held) {
    state = {};
    state.has_textures = has_textures;
    state.material = nearest_material(proxy);
    add(materials, state.material, 1.0f, state.response);
    return;
  }
  state.has_textures = has_textures;
  const math::Vec3 pull_m = proxy.position_m - contact.position_m;
  math::Vec3 x_m;
  Cut cut;
  ForceLaw& law = state.law;
  if (has_textures) {
    x_m = math::apply_inverse(object.pose, contact.position_m);
    cut = cut_of(materials, state, x_m);
    // Nothing is rendered above the triangles.
    if (law.slack_m < -cut.depth_m) law.slack_m = -cut.depth_m;
  }
  const float is_N = law.at_N(touch.penetration_m - cut.depth_m);
  const float step_N = kMaxChange_N_per_s * contact.passed_s;
  Response wanted = state.response;
  if (mean_of_active(proxy, pull_m, materials, wanted, state.material)) {
    state.response.compliance_m_per_N = wanted.compliance_m_per_N;
    follow(wanted, was_held ? is_N : 0.0f, step_N, state.response);
  }
  // Two springs in series give way to the same force.
  const float stiffness_N_per_m =
      tool_N_per_m / (1.0f + tool_N_per_m * state.response.compliance_m_per_N);
  if (was_held) {
    if (has_textures)
      change_texture(materials, x_m, step_N < is_N ? step_N / is_N : 1.0f, state, cut);
    law.approach(stiffness_N_per_m, touch.penetration_m - cut.depth_m, step_N);
  } else {
    law = {stiffness_N_per_m, 0.0f, 0.0f};
    state.textured = state.material, state.texture_share = 1.0f;
    cut = cut_of(materials, state, x_m);
  }
  touch.material.stiffness_N_per_m = law.stiffness_N_per_m;
  servo::ProxySpring& spring = model.spring;
  const float stretch_m = touch.penetration_m - cut.depth_m, force_N = law.at_N(stretch_m);
  spring.stiffness_N_per_m = force_N / touch.penetration_m;
  if (has_textures) {
    const math::Vec3 push =
        pull_m * (1.0f / touch.penetration_m) + object.pose.rotation * cut.slope;
    pull_along(push, force_N, larger(stretch_m, stretch_m - law.slack_m), contact.position_m,
               spring);
  }
}

}  // namespace firmtouch::scene
