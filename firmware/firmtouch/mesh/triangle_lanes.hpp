#pragma once
// closest_on_triangle() of four triangles side by side: the same formulas in the same order, so the
// same bits; where it branches, all branches are computed and one is chosen. For the library's own
// translation units.

#include "firmtouch/math/isa.hpp"
#include "firmtouch/mesh/triangle.hpp"

namespace firmtouch::mesh {
namespace lanes {

using math::Float4;
using math::Mask4;
using math::Vec3x4;

[[gnu::always_inline]] static inline Vec3x4 operator-(Vec3x4 a, Vec3x4 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
[[gnu::always_inline]] static inline Vec3x4 operator*(Vec3x4 a, Float4 s) {
  return {a.x * s, a.y * s, a.z * s};
}
[[gnu::always_inline]] static inline Float4 dot(Vec3x4 a, Vec3x4 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
[[gnu::always_inline]] static inline Vec3x4 choose(Mask4 mask, Vec3x4 a, Vec3x4 b) {
  return {math::select(mask, a.x, b.x), math::select(mask, a.y, b.y), math::select(mask, a.z, b.z)};
}
// 0 where the mask is not set: x - 0 is x to the bit.
[[gnu::always_inline]] static inline Float4 only(Mask4 mask, Float4 v) {
  return reinterpret_cast<Float4>(reinterpret_cast<Mask4>(v) & mask);
}
[[gnu::always_inline]] static inline Float4 all_of(float v) { return Float4{v, v, v, v}; }
[[gnu::always_inline]] static inline Mask4 all_of(Feature feature) {
  const int32_t v = static_cast<int32_t>(feature);
  return Mask4{v, v, v, v};
}

}  // namespace lanes

/// Of each lane: the offset is one from the plane's foot on the line a b, from a, from b or else
/// from c, and `moved` on from there.
struct Feet {
  math::Vec3x4 offset_m;
  math::Float4 distance2_m2;
  math::Mask4 of_line, of_a, of_b, below, moved;

  math::Mask4 features() const {
    using namespace lanes;
    using math::select;
    const Mask4 line = select(below, all_of(Feature::kEdge0), all_of(Feature::kFace));
    const Mask4 a = select(moved, all_of(Feature::kEdge2), all_of(Feature::kVertex0));
    const Mask4 b = select(moved, all_of(Feature::kEdge1), all_of(Feature::kVertex1));
    return select(of_line, line, select(of_a, a, select(of_b, b, all_of(Feature::kVertex2))));
  }
};

[[gnu::always_inline]] static inline Feet closest_on_triangles(math::Vec3 p_m, math::Vec3x4 a,
                                                               math::Vec3x4 b, math::Vec3x4 c) {
  using namespace lanes;
  using math::at_most;
  using math::less;
  using math::select;
  const Float4 zero{}, one = all_of(1.0f);
  const Vec3x4 p{all_of(p_m.x), all_of(p_m.y), all_of(p_m.z)};
  const Vec3x4 ab = b - a, ac = c - a, ap = p - a, bc = c - b, bp = p - b, cp = p - c;
  const Float4 per_ab2 = one / dot(ab, ab);
  const Float4 x = dot(ab, ap) * per_ab2;
  const Float4 xc = dot(ab, ac) * per_ab2;
  const Vec3x4 e = ap - ab * x, h = ac - ab * xc;
  const Float4 y = dot(e, h);
  const Float4 w = y / dot(h, h);
  const Float4 v = x - w * xc;
  const Float4 t_ac = dot(ac, ap), ac2 = dot(ac, ac), t_bc = dot(bc, bp), bc2 = dot(bc, bc);
  const Float4 part_ac = t_ac / ac2, part_bc = t_bc / bc2;

  const Mask4 at_a = at_most(t_ac, zero), at_b = at_most(t_bc, zero);
  const Mask4 beyond_ac = at_most(v, zero), beyond_bc = at_most(one, v + w);
  const Mask4 before = at_most(x, zero), behind = at_most(one, x);
  const Mask4 below = at_most(y, zero);
  Feet feet;
  feet.below = below;
  feet.of_line = ~select(below, before | behind, beyond_ac | beyond_bc);
  feet.of_a = select(below, before, beyond_ac & (at_a | less(t_ac, ac2)));
  feet.of_b = select(below, behind, beyond_bc & (at_b | less(t_bc, bc2)));
  feet.moved = ~below & (feet.of_line | select(feet.of_a, ~at_a, feet.of_b & ~at_b));
  const Vec3x4 from = choose(feet.of_line, e, choose(feet.of_a, ap, choose(feet.of_b, bp, cp)));
  const Vec3x4 along = choose(feet.of_line, h, choose(feet.of_a, ac, bc));
  const Vec3x4 way = along * select(feet.of_line, w, select(feet.of_a, part_ac, part_bc));
  feet.offset_m =
      from - Vec3x4{only(feet.moved, way.x), only(feet.moved, way.y), only(feet.moved, way.z)};
  feet.distance2_m2 = dot(feet.offset_m, feet.offset_m);
  return feet;
}

}  // namespace firmtouch::mesh
