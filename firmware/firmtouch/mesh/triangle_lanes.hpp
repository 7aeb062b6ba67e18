#pragma once
// closest_on_triangle() of triangles side by side: the same formulas in the same order, so the
// same bits; where it branches, all branches are computed and one is chosen. For the library's own
// translation units.

#include "firmtouch/math/isa_lanes.hpp"
#include "firmtouch/mesh/triangle.hpp"

namespace firmtouch::mesh {
namespace lanes {

using math::Lanes;

template <class Float>
using Mask = decltype(math::less(Float{}, Float{}));

template <class Float>
[[gnu::always_inline]] static inline Lanes<Float> operator-(const Lanes<Float>& a,
                                                            const Lanes<Float>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class Float>
[[gnu::always_inline]] static inline Lanes<Float> operator*(const Lanes<Float>& a, Float s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class Float>
[[gnu::always_inline]] static inline Float dot(const Lanes<Float>& a, const Lanes<Float>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class Float>
[[gnu::always_inline]] static inline Lanes<Float> choose(Mask<Float> mask, const Lanes<Float>& a,
                                                         const Lanes<Float>& b) {
  return {math::select(mask, a.x, b.x), math::select(mask, a.y, b.y), math::select(mask, a.z, b.z)};
}
// 0 where the mask is not set: x - 0 is x to the bit.
template <class Float>
[[gnu::always_inline]] static inline Float only(Mask<Float> mask, Float v) {
  return reinterpret_cast<Float>(reinterpret_cast<Mask<Float>>(v) & mask);
}
template <class Float>
[[gnu::always_inline]] static inline Float all_of(float v) {
  return v - Float{};  // - 0 is v to the bit, + 0 would lose a sign
}

}  // namespace lanes

/// Of each lane: the offset is one from the plane's foot on the line a b, from a, from b or else
/// from c, and `moved` on from there.
template <class Float>
struct Feet {
  using Mask = lanes::Mask<Float>;
  math::Lanes<Float> offset_m;
  Float distance2_m2;
  Mask of_line, of_a, of_b, below, moved;

  Mask features() const {
    using math::select;
    const auto all = [](Feature feature) { return Mask{} + static_cast<int32_t>(feature); };
    const Mask line = select(below, all(Feature::kEdge0), all(Feature::kFace));
    const Mask a = select(moved, all(Feature::kEdge2), all(Feature::kVertex0));
    const Mask b = select(moved, all(Feature::kEdge1), all(Feature::kVertex1));
    return select(of_line, line, select(of_a, a, select(of_b, b, all(Feature::kVertex2))));
  }
};

/// What of each lane's triangle depends on nothing else: as in find_foot().
template <class Float>
struct Frames {
  math::Lanes<Float> a, ab, h;
  Float per_ab2, xc, h2;
};

template <class Float>
[[gnu::always_inline]] static inline Frames<Float> frames_of(const math::Lanes<Float>& a,
                                                             const math::Lanes<Float>& b,
                                                             const math::Lanes<Float>& c) {
  using namespace lanes;
  Frames<Float> f;
  f.a = a, f.ab = b - a;
  const Lanes<Float> ac = c - a;
  f.per_ab2 = all_of<Float>(1.0f) / dot(f.ab, f.ab);
  f.xc = dot(f.ab, ac) * f.per_ab2;
  f.h = ac - f.ab * f.xc;
  f.h2 = dot(f.h, f.h);
  return f;
}

/// Of each lane the foot in the triangle's plane.
template <class Float>
struct PlaneFeet {
  math::Lanes<Float> ap, e;
  Float x, y, w, v;
};

template <class Float>
[[gnu::always_inline]] static inline PlaneFeet<Float> plane_feet(const Frames<Float>& f,
                                                                 math::Vec3 p_m) {
  using namespace lanes;
  const Lanes<Float> p{all_of<Float>(p_m.x), all_of<Float>(p_m.y), all_of<Float>(p_m.z)};
  PlaneFeet<Float> foot;
  foot.ap = p - f.a;
  foot.x = dot(f.ab, foot.ap) * f.per_ab2;
  foot.e = foot.ap - f.ab * foot.x;
  foot.y = dot(foot.e, f.h);
  foot.w = foot.y / f.h2;
  foot.v = foot.x - foot.w * f.xc;
  return foot;
}

/// Pre: the frames are those of a, b and c, the feet those of p_m.
template <class Float>
[[gnu::always_inline]] static inline Feet<Float> closest_in_frames(const Frames<Float>& f,
                                                                   const PlaneFeet<Float>& foot,
                                                                   math::Vec3 p_m,
                                                                   const math::Lanes<Float>& b,
                                                                   const math::Lanes<Float>& c) {
  using namespace lanes;
  using math::at_most;
  using math::less;
  using math::select;
  using Mask = lanes::Mask<Float>;
  const Float zero{}, one = all_of<Float>(1.0f);
  const Lanes<Float> p{all_of<Float>(p_m.x), all_of<Float>(p_m.y), all_of<Float>(p_m.z)};
  const Lanes<Float> ac = c - f.a, ap = foot.ap, e = foot.e, h = f.h;
  const Lanes<Float> bc = c - b, bp = p - b, cp = p - c;
  const Float x = foot.x, y = foot.y, w = foot.w, v = foot.v;
  const Float t_ac = dot(ac, ap), ac2 = dot(ac, ac), t_bc = dot(bc, bp), bc2 = dot(bc, bc);
  const Float part_ac = t_ac / ac2, part_bc = t_bc / bc2;

  const Mask at_a = at_most(t_ac, zero), at_b = at_most(t_bc, zero);
  const Mask beyond_ac = at_most(v, zero), beyond_bc = at_most(one, v + w);
  const Mask before = at_most(x, zero), behind = at_most(one, x);
  const Mask below = at_most(y, zero);
  Feet<Float> feet;
  feet.below = below;
  feet.of_line = ~select(below, before | behind, beyond_ac | beyond_bc);
  feet.of_a = select(below, before, beyond_ac & (at_a | less(t_ac, ac2)));
  feet.of_b = select(below, behind, beyond_bc & (at_b | less(t_bc, bc2)));
  feet.moved = ~below & (feet.of_line | select(feet.of_a, ~at_a, feet.of_b & ~at_b));
  const Lanes<Float> from =
      choose(feet.of_line, e, choose(feet.of_a, ap, choose(feet.of_b, bp, cp)));
  const Lanes<Float> along = choose(feet.of_line, h, choose(feet.of_a, ac, bc));
  const Lanes<Float> way = along * select(feet.of_line, w, select(feet.of_a, part_ac, part_bc));
  feet.offset_m = from - Lanes<Float>{only(feet.moved, way.x), only(feet.moved, way.y),
                                      only(feet.moved, way.z)};
  feet.distance2_m2 = dot(feet.offset_m, feet.offset_m);
  return feet;
}

template <class Float>
[[gnu::always_inline]] static inline Feet<Float> closest_on_triangles(math::Vec3 p_m,
                                                                      const math::Lanes<Float>& a,
                                                                      const math::Lanes<Float>& b,
                                                                      const math::Lanes<Float>& c) {
  const Frames<Float> f = frames_of(a, b, c);
  return closest_in_frames(f, plane_feet(f, p_m), p_m, b, c);
}

}  // namespace firmtouch::mesh
