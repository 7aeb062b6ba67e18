#pragma once
// A segment against triangles, in floats where their error bound decides. For the library's own
// translation units.

#include "firmtouch/math/vec3_ops.hpp"
#include "firmtouch/mesh/exact_crossing.hpp"
#include "firmtouch/mesh/layout.hpp"

namespace firmtouch::mesh {

// Largest error of a crossing's t. If the bound of the floats is larger, integers compute it.
constexpr float kTimeError = 0x1p-18f;

static inline float absolute(float v) { return __builtin_fabsf(v); }
static inline float larger(float a, float b) { return a > b ? a : b; }
static inline float smaller(float a, float b) { return a < b ? a : b; }

// How a segment's line passes a triangle's three edges.
enum class Pass { kMisses, kEnters, kLeaves, kUnsure };

/// How a segment is sheared so that it runs along its longest axis k; i and j are the next two
/// axes, cyclically.
struct Shear {
  uint32_t i, j, k;
  float along_i, along_j;  // for each step along k
  bool is_back;

  [[gnu::always_inline]] inline explicit Shear(math::Vec3 along_m) {  // without a branch
    const float x = absolute(along_m.x), y = absolute(along_m.y), z = absolute(along_m.z);
    const uint32_t is_x = (x > y ? 1u : 0u) & (x > z ? 1u : 0u);
    const uint32_t is_y = (y > z ? 1u : 0u) & (1u - is_x);
    k = 2 - 2 * is_x - is_y, i = (0x09u >> (2 * k)) & 3u, j = (0x12u >> (2 * k)) & 3u;
    const float along[3] = {along_m.x, along_m.y, along_m.z}, inverse = 1.0f / along[k];
    along_i = -along[i] * inverse, along_j = -along[j] * inverse;
    is_back = along[k] < 0.0f;
  }
};

/// A segment against a triangle that its line is known to pass: whether and where it crosses.
class SegmentLine {
 public:
  SegmentLine() = default;
  /// `low_m` and `high_m`: the box of all vertices.
  [[gnu::always_inline]] inline SegmentLine(const float (&low_m)[3], const float (&high_m)[3],
                                            math::Vec3 a_m, math::Vec3 b_m)
      : a_m_(a_m), b_m_(b_m), along_m_(b_m - a_m) {
    float reach_m = 0.0f;
    const float at[3] = {a_m.x, a_m.y, a_m.z};
    for (uint32_t n = 0; n < 3; ++n)
      reach_m = larger(reach_m, larger(absolute(low_m[n] - at[n]), absolute(high_m[n] - at[n])));
    coordinate_error_m_ = reach_m * (10.5f * 0x1p-24f);
    side_error_m_ = reach_m * (53.0f * 0x1p-24f);
    side_error_m2_ = side_error_m_ * (reach_m * 0x1p-21f) + kUnderflow;
  }

 protected:
  /// As SegmentFrame::decides(), for a triangle that the line is known to pass.
  [[gnu::always_inline]] inline bool decides(Pass way, math::Vec3 p, math::Vec3 q, math::Vec3 r,
                                             Crossing& reported, float& early) const {
    reported = {};
    early = 1.0f;
    if (way == Pass::kMisses) return true;
    float error;
    bool is_bounded;
    const float t = time(p, q, r, error, is_bounded);
    const bool is_through = way != Pass::kUnsure;
    if (is_through && error <= kTimeError && (t < -error || t > 1.0f + error)) return true;
    const bool is_sure = is_through && error <= kTimeError && t > error && t < 1.0f - error;
    if (is_through) reported.direction = (way == Pass::kLeaves) != flips_ ? 1 : -1;
    if (is_sure) reported.t = t;
    // Unless the triangle is tiny, the line passes its plane near it, and t is the plane's.
    const bool is_speck = larger(largest(q - p), largest(r - p)) < coordinate_error_m_;
    if (is_sure || !is_bounded || is_speck) return is_sure;
    // First order in the error of the rate and of all else; twice that if a side is undecided.
    const float wide = (is_through ? 1.5f : 3.0f) * error;
    if (t < -wide || t > 1.0f + wide) {
      reported.direction = 0;
      return true;
    }
    reported.t = larger(t - wide, 0.0f);
    if (is_through && t > wide && t < 1.0f - wide) early = 2.0f * wide;
    return false;
  }

  // Products that underflow lose at most this much.
  static constexpr float kUnderflow = 1e-36f;

  // From the plane. The error of n matters only as n . (p - hit), within the triangle: with L its
  // longer edge at p, 9 u L^2 an axis times 3 L. Each sum of products is off by 5 u of the sum of
  // their magnitudes.
  float time(math::Vec3 p, math::Vec3 q, math::Vec3 r, float& error, bool& is_bounded) const {
    const math::Vec3 e = q - p, f = r - p, n = cross(e, f), to_p = p - a_m_;
    const float depth = dot(n, to_p), rate = dot(n, along_m_);
    const float t = depth / rate;
    const float depth_size = sum_of_sizes(n, to_p), rate_size = sum_of_sizes(n, along_m_);
    const float edge = larger(largest(e), largest(f));
    const float lost = 6.0f * (depth_size + absolute(t) * rate_size) + 30.0f * edge * edge * edge;
    // If the products underflow or the divisor vanishes, there is no bound.
    const bool is_sound = absolute(rate) > 1e-30f;
    is_bounded = is_sound && rate_size * 0x1p-19f < absolute(rate);  // off by a quarter at most
    error = is_sound ? lost / absolute(rate) * 0x1p-24f + 0x1p-24f * absolute(t) : 1e30f;
    return t;
  }
  static float sum_of_sizes(math::Vec3 a, math::Vec3 b) {
    return absolute(a.x * b.x) + absolute(a.y * b.y) + absolute(a.z * b.z);
  }
  static float largest(math::Vec3 a) {
    return larger(absolute(a.x), larger(absolute(a.y), absolute(a.z)));
  }

  math::Vec3 a_m_, b_m_, along_m_;
  bool flips_;
  float coordinate_error_m_, side_error_m_, side_error_m2_;
};

/// The segment's own frame: the origin at a, sheared along its longest axis so that it runs along
/// that axis. The sign of the cross product of an edge's two sheared corners says on which side the
/// line passes the edge.
///
/// With u = 2^-24, R the largest coordinate of any vertex as seen from a, and a direction whose
/// shears are at most 1 and off by 4 u: a difference is off by u R, its shear by 6 u R, the sheared
/// coordinate by 7 u R and its own rounding, at most 2 u R: 10 u R with a unit to spare. With S the
/// largest sheared coordinate of a triangle (at most 2 R), a cross product is then off by 40 u R S
/// + 200 u^2 R^2 and its roundings by 4 u S^2 <= 8 u R S; rounded up to 52 u R (S + 8 u R).
class SegmentFrame : private SegmentLine {
 public:
  SegmentFrame() = default;
  SegmentFrame(const Head& head, math::Vec3 a_m, math::Vec3 b_m)
      : SegmentFrame(head.low_m, head.high_m, a_m, b_m) {}
  /// `low_m` and `high_m`: the box of all vertices.
  SegmentFrame(const float (&low_m)[3], const float (&high_m)[3], math::Vec3 a_m, math::Vec3 b_m)
      : SegmentLine(low_m, high_m, a_m, b_m) {
    // Rows of the shear: their zeros and ones multiply exactly.
    const Shear shear(along_m_);
    flips_ = shear.is_back;
    float row[2][3] = {};
    row[0][shear.i] = row[1][shear.j] = 1.0f;
    row[0][shear.k] = shear.along_i;
    row[1][shear.k] = shear.along_j;
    row_[0] = {row[0][0], row[0][1], row[0][2]};
    row_[1] = {row[1][0], row[1][1], row[1][2]};
  }

  /// A vertex in the frame; several triangles may share it.
  struct Sheared {
    float x, y;
  };
  Sheared sheared(math::Vec3 vertex_m) const {
    const math::Vec3 v = vertex_m - a_m_;
    return {math::dot(row_[0], v), math::dot(row_[1], v)};
  }
  /// Whether floats prove that the triangle is not crossed.
  bool misses(Sheared p, Sheared q, Sheared r) const {
    const float e = coordinate_error_m_;  // most lie to one side
    if (p.x > e ? q.x > e && r.x > e : p.x < -e && q.x < -e && r.x < -e) return true;
    if (p.y > e ? q.y > e && r.y > e : p.y < -e && q.y < -e && r.y < -e) return true;
    return pass(p, q, r) == Pass::kMisses;
  }

  /// Result: as exact_crossing(), with |t - exact| <= kTimeError. The same bits whether floats or
  /// integers decided: a decision of the floats is that of the integers.
  Crossing crossing(math::Vec3 p, math::Vec3 q, math::Vec3 r) const {
    Crossing reported;
    float early;
    return decides(p, q, r, reported, early) ? reported : exact_crossing(a_m_, b_m_, p, q, r);
  }

  /// Whether floats decide: then the crossing is that of crossing(). Else its direction is 0 if
  /// floats cannot prove that the triangle is crossed, and otherwise its t is early, by at most
  /// `early`.
  bool decides(math::Vec3 p, math::Vec3 q, math::Vec3 r, Crossing& reported, float& early) const {
    return SegmentLine::decides(pass(sheared(p), sheared(q), sheared(r)), p, q, r, reported, early);
  }

 private:
  // With NaN and infinities every comparison ends as undecided.
  Pass pass(Sheared p, Sheared q, Sheared r) const {
    const float high_x = larger(p.x, larger(q.x, r.x)), low_x = smaller(p.x, smaller(q.x, r.x));
    const float high_y = larger(p.y, larger(q.y, r.y)), low_y = smaller(p.y, smaller(q.y, r.y));
    const float e = coordinate_error_m_;
    if (low_x > e || high_x < -e || low_y > e || high_y < -e) return Pass::kMisses;
    const float size = larger(larger(high_x, -low_x), larger(high_y, -low_y));
    const float error = side_error_m_ * size + side_error_m2_;
    const float pq = p.x * q.y - p.y * q.x, qr = q.x * r.y - q.y * r.x, rp = r.x * p.y - r.y * p.x;
    const float low = smaller(pq, smaller(qr, rp)), high = larger(pq, larger(qr, rp));
    if (low < -error && high > error) return Pass::kMisses;
    if (low > error) return Pass::kLeaves;
    if (high < -error) return Pass::kEnters;
    return Pass::kUnsure;
  }

  math::Vec3 row_[2];
};

}  // namespace firmtouch::mesh
