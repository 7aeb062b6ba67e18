#pragma once
#include "firmtouch/scene/proxy_contact.hpp"
#include "firmtouch/scene/texture.hpp"

// Texture of a shape without triangles: spline surfaces, shapes in closed form, your own. The law
// is that of scene/texture.hpp.
namespace firmtouch::scene {

/// State of a (tool, shape) pair from tick to tick, beside its ProxyTouch. The caller owns one a
/// pair.
struct TexturedTouch {
  bool is_held = false;  // the proxy was, at the end of the last tick
};

/// Before the proxy moves. Servo held a spring to another place than the proxy.
void begin_texture(ProxyContact& contact, const ProxyTouch& touch, const TexturedTouch& state);
/// After touch_by_proxy(): the model's spring pulls to where the texture has it. `cut`: at the
/// tool, in the shape's frame. One deeper than kMaxTextureHeight_m, above the shape, steeper than
/// kMaxTextureSlope, or with NaN, counts as none.
/// Bounds: about 120 instructions.
void end_texture(const ProxyContact& contact, const Cut& cut, const math::RigidTransform& pose,
                 const ProxyTouch& touch, TexturedTouch& state, servo::LocalModel& model);

/// In the shape's frame. `position_m`: device frame.
math::Vec3 place_in(const math::RigidTransform& pose, math::Vec3 position_m);

/// touch_by_proxy() of a shape with a texture. `texture(x_m)` returns the Cut at a place in the
/// shape's frame, such as cut_at() or a sum with add_relief(): the same one in all ticks of a
/// contact. On closed ways a resting shape gives no energy.
template <class Shape, class Texture>
void touch_textured(const ProxyContact& contact, const Texture& texture,
                    const math::RigidTransform& pose, Shape& shape, ProxyTouch& touch,
                    TexturedTouch& state, servo::LocalModel& model) {
  ProxyContact used = contact;
  begin_texture(used, touch, state);
  touch_by_proxy(used, shape, touch, model);
  end_texture(contact, texture(place_in(pose, contact.position_m)), pose, touch, state, model);
}

}  // namespace firmtouch::scene
