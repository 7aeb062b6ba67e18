#pragma once
#include "firmtouch/core/span.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/scene/materials_layout.hpp"

// Texture: heights of the triangles of a material, without more triangles. The proxy stays in front
// of the triangles, and its theorems hold unchanged. The height is taken off inside the spring, by
// c(x) at the hand x: crests are at the triangle, troughs below it. Of a hand x and a proxy p
//
//     stretch  s = |p - x| - c(x), no force where it is not positive
//     energy   k s^2 / 2
//     force    k s ((p - x) / |p - x| + grad c(x)), its negative gradient
//
// So a hand gains nothing on a closed way while the proxy rests. A move of the proxy never
// lengthens |p - x|, and c does not depend on it: it gives no energy either, with friction, in
// corners and over edges. On a face the height at the proxy is rendered: without friction hand and
// proxy differ only across the face, where waves along it do not change. Let waves run along the
// surface: others change while the hand presses, too, by at most their slope.
//
// Stiffness, the energy's second derivative: of u = (p - x) / |p - x| + grad c and the curvature C
// of c it is k u u^T - k s C. Along u it has the contact's damper and is k |u|^2 <= k (1 +
// slope)^2. In a trough the force times |C| is added along the surface, where only the device's own
// damping acts; a wave has up to |C| = 2 height (pi / length)^2. A stable wall must allow for both.
namespace firmtouch::scene {

/// How far a texture is below the triangle, and how fast that grows.
struct Cut {
  float depth_m = 0;
  math::Vec3 slope;
};

/// At `x_m`, both in the mesh's frame.
/// Bounds: about 100 instructions a wave. Result: finite; NaN: as at a crest.
/// Error: x_m rounds by 2^-24: 2^-23 pi |x| / length of the height.
Cut cut_at(const TextureLayout& texture, math::Vec3 x_m);

/// The most by which textures stiffen a contact, on any face.
struct Stiffening {
  float share = 1;  // times its stiffness: across the surface
  float per_m = 0;  // times its force: along the surface
};
Stiffening stiffening_of(core::Span<const TextureLayout> textures,
                         core::Span<const ReliefLayout> reliefs = {});

}  // namespace firmtouch::scene
