#pragma once
// mesh::closest_on_triangle() of eight triangles at once: the same formulas in the same order, so
// the same bits. Where it branches, all branches are computed and one is selected.

#include "firmtouch/mesh/triangle.hpp"
#include "simd/search/vectors.hpp"

namespace firmtouch::simd {
using mesh::Feature;

/// Of each lane: the offset is one from the plane's foot on the line a b, from a, from b or else
/// from c, and `moved` on from there.
struct Feet {
  Lanes offset_m;
  Float8 distance2_m2;
  Mask8 of_line, of_a, of_b, below, moved;

  Mask8 features() const {
    const auto all = [](Feature feature) { return all_of_bits(static_cast<int32_t>(feature)); };
    const Mask8 line = select(below, all(Feature::kEdge0), all(Feature::kFace));
    const Mask8 a = select(moved, all(Feature::kEdge2), all(Feature::kVertex0));
    const Mask8 b = select(moved, all(Feature::kEdge1), all(Feature::kVertex1));
    return select(of_line, line, select(of_a, a, select(of_b, b, all(Feature::kVertex2))));
  }
};

/// What of each lane's triangle depends on nothing else: as in find_foot().
struct Frames {
  Lanes a, ab, h;
  Float8 per_ab2, xc, h2;
};

/// Pre: the frames are those of triangles a b c.
[[gnu::always_inline]] static inline Feet closest_on_triangles(const Frames& f, math::Vec3 p_m,
                                                               const Lanes& b, const Lanes& c) {
  const Float8 zero = all_of(0.0f), one = all_of(1.0f);
  const Lanes p = all_of(p_m), ap = p - f.a;
  const Float8 x = dot(f.ab, ap) * f.per_ab2;
  const Lanes e = ap - f.ab * x, h = f.h;
  const Float8 y = dot(e, h), w = y / f.h2, v = x - w * f.xc;
  const Lanes ac = c - f.a, bc = c - b, bp = p - b, cp = p - c;
  const Float8 t_ac = dot(ac, ap), ac2 = dot(ac, ac), t_bc = dot(bc, bp), bc2 = dot(bc, bc);
  const Float8 part_ac = t_ac / ac2, part_bc = t_bc / bc2;

  const Mask8 at_a = at_most(t_ac, zero), at_b = at_most(t_bc, zero);
  const Mask8 beyond_ac = at_most(v, zero), beyond_bc = at_most(one, v + w);
  const Mask8 before = at_most(x, zero), behind = at_most(one, x);
  const Mask8 below = at_most(y, zero);
  Feet feet;
  feet.below = below;
  feet.of_line = ~select(below, before | behind, beyond_ac | beyond_bc);
  feet.of_a = select(below, before, beyond_ac & (at_a | less(t_ac, ac2)));
  feet.of_b = select(below, behind, beyond_bc & (at_b | less(t_bc, bc2)));
  feet.moved = ~below & (feet.of_line | select(feet.of_a, ~at_a, feet.of_b & ~at_b));
  const Lanes from = select(feet.of_line, e, select(feet.of_a, ap, select(feet.of_b, bp, cp)));
  const Lanes along = select(feet.of_line, h, select(feet.of_a, ac, bc));
  const Lanes way = along * select(feet.of_line, w, select(feet.of_a, part_ac, part_bc));
  feet.offset_m =
      from - Lanes{only(feet.moved, way.x), only(feet.moved, way.y), only(feet.moved, way.z)};
  feet.distance2_m2 = dot(feet.offset_m, feet.offset_m);
  return feet;
}

}  // namespace firmtouch::simd
