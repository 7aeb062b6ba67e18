#pragma once
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
// At a crest the stiffness along the surface is up to force x height x 2 (pi / length)^2: a stable
// wall must allow for it.
namespace firmtouch::scene {

/// How far a texture is below the triangle, and how fast that grows.
struct Cut {
  float depth_m = 0;
  math::Vec3 slope;
};

/// At `x_m`, both in the mesh's frame.
/// Bounds: about 90 instructions a wave. Result: finite; NaN: as at a crest.
/// Error: x_m rounds by 2^-24: 2^-23 pi |x| / length of the height.
Cut cut_at(const TextureLayout& texture, math::Vec3 x_m);

}  // namespace firmtouch::scene
