#pragma once
// What is derived of a leaf's coefficients: for the proof at open, and for the baker, which stores
// it.
#include <stdint.h>

#include "firmtouch/math/vec3.hpp"
#include "firmtouch/spline/layout.hpp"
#include "firmtouch/spline/surface/patch.hpp"

namespace firmtouch::spline {

/// The part of a piece that a leaf covers. `level` halvings of -1 to 1, the `index`th from -1.
struct Region {
  float middle_u, half_u;
  float middle_v, half_v;  // 0, 1 for a curve
};
Region region_of(const Piece& piece, uint32_t index_u, uint32_t index_v);
/// The `u`th and `v`th of parts halved so often.
Region region_of(const Halvings& made, uint32_t u, uint32_t v);

/// A leaf about its middle, in leaf coordinates x (and y) from -1 to 1: with the powers of x
/// fastest, point(x, y) = middle_m + (sum of c[i, j] x^i y^j) / (sum of w[i, j] x^i y^j).
struct LeafShape {
  static constexpr uint32_t kMax = (kMaxDegree + 1) * (kMaxDegree + 1);
  bool is_rational = false;
  uint32_t degree_u = 0, degree_v = 0;
  math::Vec3 middle_m, local_m;  // the latter from the piece's origin
  math::Vec3 c[kMax];            // c[0] is what float32 left of it, next to nothing
  float w[kMax];                 // w[0] = 1
  float min_weight = 0;          // on the leaf; where it is not above 1 / 2 nothing else is known
  float noise_m = 0;             // of any point of it, as computed here
  float reach_m = 0;             // no point of the leaf is farther from middle_m
  float loss_m = 0;  // of a point that evaluation.hpp computes, beside 5 units of its distance
  // By which a coefficient of the numerator, or of the weight, may be off, times the powers of the
  // part's halves that belong to it.
  float numerator_noise_m = 0, weight_noise = 0;
  float fixed[5] = {}, turning[5] = {};  // of bound_bends(): as PatchBend says
};

/// All but fixed and turning.
/// Pre: the piece's coefficients lie at `coefficients`, its degrees and part are in range.
void derive(const Piece& piece, const float* coefficients, const Region& region, LeafShape& shape);

/// The least and the most of (point - centre_m) . axis over the leaf, rounded outward: by its
/// coefficients, or in a third of the time by the ball about its middle.
struct Extent {
  float low, high;
};
enum class By : uint8_t { kBall, kCoefficients };
Extent extent_along(const LeafShape& shape, math::Vec3 centre_m, math::Vec3 axis,
                    By by = By::kCoefficients);

/// What a stored radius or half side must at least be, so that it also holds what float32 loses
/// when a query measures against it.
float radius_for(const LeafShape& shape, math::Vec3 a_m, math::Vec3 b_m);
/// The same of a node above: the leaf's own capsule and the node's.
float radius_above(float leaf_radius_m, math::Vec3 leaf_a_m, math::Vec3 leaf_b_m, math::Vec3 a_m,
                   math::Vec3 b_m);
/// Of a box with this centre and these axes, to hold the leaf: enlarges half_m.
void enlarge(const LeafShape& shape, Box& box, By by = By::kCoefficients);

/// Whether a box holds a leaf.
bool leaf_fits(const LeafShape& shape, const Box& box);

/// The least byte whose value, in such units, is not below `value`; 256 where there is none.
uint32_t byte_above(float unit, float value);

}  // namespace firmtouch::spline
