#pragma once
// Error bounds of a float32 distance to a triangle. For the library's own translation units.

#include "firmtouch/math/isa.hpp"
#include "firmtouch/math/vec3.hpp"
#include "firmtouch/mesh/layout.hpp"

namespace firmtouch::mesh {

/// Bound of an exact answer's error in distance and lower bound, relative to max(diagonal,
/// distance): a little inside of 4e-7.
constexpr float kPromise = 3.9e-7f;

/// Bounds of the error of closest_on_triangle(), with u = 2^-24, d the distance and L the mesh's
/// longest edge (first order; 2 % are added for the rest).
///
/// The offset is p - q rounded, with q a point of the triangle except for the error of h. Roundings
/// of the vector: ap by u |ap| <= u (d + L); ab x by 2 u L; e by u (d + 0.9 L); h w by u (4.9 L)
/// for h and its product; the last difference by u d. Squares, their sum and the root lose 2.5 u d.
/// Together u (5.5 d + 8.8 L). Of x the error is 5 u (d + L) / L + 6.5 u, of w (d + L + 2 L) u /
/// |h| + 7 u (d + 0.9 L) / |h| beside the sliver's term (mesh/triangle.hpp, at most u L / 2 in d):
/// they move q in the plane by at most u (13 d + 21 L). That lengthens d by as much where d is of
/// that size, where 13 u d is nothing, and by its square over 2 d, nothing, where d is larger: u 18
/// L at most.
struct Loss {
  float longest_edge_m;
  float rounding_m;  // of the model's coordinates: a lower bound holds for the model as imported

  explicit Loss(const Head& head)
      : longest_edge_m(head.longest_edge_m), rounding_m(head.rounding_m) {}

  /// Whether float32 alone keeps kPromise at the surface.
  bool is_within_promise(float diagonal_m) const {
    return 2.0f * (plain_m(0.0f) + rounding_m) <= kPromise * diagonal_m;
  }
  float plain_m(float distance_m) const {
    return 0x1p-24f * (5.7f * distance_m + 28.0f * longest_edge_m) + kVanishing_m;
  }
  /// plain_m() plus the rounding of distance - loss.
  float reported_m(float distance_m) const {
    return 0x1p-24f * (6.7f * distance_m + 28.0f * longest_edge_m) + kVanishing_m;
  }
  /// reported_m() of a triangle whose longest edge ab has this square, with the foot at most
  /// `reach_m` from corner a; on the edge b c from corner b.
  ///
  /// Where the distance is more than 2^-12 of the edge, the shift in the plane adds less than u L /
  /// 16: the loss is that of the offset along itself, linear in the foot's parts X along ab and Y
  /// across, r = |X, Y|. Roundings of ap, e and h: u (r + Y + Y); of the products ab x, ab xc w and
  /// h w: u (X + X + Y), because w xc |ab| <= X; of ab and ac themselves, which count with the
  /// foot's shares v and w: u (v |ab| + w |ac|) <= u (X + Y). Together u (r + 3 X + 4 Y) <= 6 u r;
  /// at an edge 3 u r.
  [[gnu::always_inline]] static inline float own_m(float distance_m, float ab2_m2, float reach_m,
                                                   bool is_face) {
    const float edge_m = math::square_root(ab2_m2);
    const bool is_clear = distance_m * distance_m > ab2_m2 * 0x1p-24f;
    const float lost_m =
        is_clear ? (is_face ? 6.2f : 3.1f) * reach_m + 0.1f * edge_m : 28.0f * edge_m;
    return 0x1p-24f * (6.7f * distance_m + lost_m) + kVanishing_m;
  }
  /// Of compensated_distance2() and its root: one rounding each, the first halved by the root.
  float compensated_m(float distance_m) const {
    return 0x1p-24f * (1.6f * distance_m + 0x1p-4f * longest_edge_m) + kVanishing_m;
  }
  /// Whether the true value of a plain squared distance may be below a compensated one.
  bool may_be_less(float plain2_m2, float compensated2_m2) const {
    const float distance_m = math::square_root(plain2_m2);
    return distance_m - plain_m(distance_m) <=
           math::square_root(compensated2_m2) * (1.0f + 0x1p-23f);
  }

 private:
  static constexpr float kVanishing_m = 0x1p-60f;  // squares of less underflow
};

}  // namespace firmtouch::mesh
