#include "firmtouch/spline/curve/point.hpp"

#include "firmtouch/spline/numbers.hpp"

namespace firmtouch::spline {
namespace {

using math::Vec3;

/// A polynomial with its first derivative, half its second and a sixth of its third (Horner).
template <class T>
struct Jet {
  T value, first{}, half_second{}, sixth_third{};
  explicit Jet(T c) : value(c) {}
  void add_power(T c, float s) {
    sixth_third = sixth_third * s + half_second;
    half_second = half_second * s + first;
    first = first * s + value;
    value = value * s + c;
  }
};

// Numerator over weight, with the derivatives of both (Leibniz' rule).
void divide(float& x, float& d1, float& d2, float& d3, float per_w, float w1, float w2, float w3) {
  x = x * per_w;
  d1 = (d1 - x * w1) * per_w;
  d2 = (d2 - d1 * (2.0f * w1) - x * w2) * per_w;
  d3 = (d3 - d2 * (3.0f * w1) - d1 * (3.0f * w2) - x * w3) * per_w;
}
void divide(CurvePoint& p, float w, float w1, float w2, float w3) {
  const float per_w = 1.0f / w;
  divide(p.x.x, p.d1.x, p.d2.x, p.d3.x, per_w, w1, w2, w3);
  divide(p.x.y, p.d1.y, p.d2.y, p.d3.y, per_w, w1, w2, w3);
  divide(p.x.z, p.d1.z, p.d2.z, p.d3.z, per_w, w1, w2, w3);
}

// One coordinate of a cubic with its derivatives: no term that is always 0 is computed.
inline void cubic_at(const float* c, uint32_t stride, float s, float& x, float& d1, float& d2,
                     float& d3) {
  const float top = c[3 * stride] * s, a = top + c[2 * stride], b = a * s + c[stride];
  const float d = top + a;
  x = b * s + c[0];
  d1 = d * s + b;
  d2 = (top + d) * 2.0f;
  d3 = c[3 * stride] * 6.0f;
}

inline void evaluate_cubic(const float* c, uint32_t stride, float s, CurvePoint& point) {
  cubic_at(c, stride, s, point.x.x, point.d1.x, point.d2.x, point.d3.x);
  cubic_at(c + 1, stride, s, point.x.y, point.d1.y, point.d2.y, point.d3.y);
  cubic_at(c + 2, stride, s, point.x.z, point.d1.z, point.d2.z, point.d3.z);
}

void evaluate_any(const Piece& piece, const float* c, float s, CurvePoint& point) {
  const uint32_t stride = piece.is_rational != 0 ? 4 : 3;
  c += piece.degree_u * stride;
  Jet<Vec3> jet(vec3_at(c));
  Jet<float> weight(piece.is_rational != 0 ? c[3] : 1.0f);
  for (uint32_t k = piece.degree_u; k > 0; --k) {
    c -= stride;
    jet.add_power(vec3_at(c), s);
    if (piece.is_rational != 0) weight.add_power(c[3], s);
  }
  point.x = jet.value;
  point.d1 = jet.first;
  point.d2 = jet.half_second * 2.0f;
  point.d3 = jet.sixth_third * 6.0f;
  if (piece.is_rational != 0)
    divide(point, weight.value, weight.first, weight.half_second * 2.0f, weight.sixth_third * 6.0f);
}

}  // namespace

void evaluate(const Piece& piece, const float* coefficients, float s, CurvePoint& point) {
  const float* const c = coefficients + piece.coefficients;
  if (piece.degree_u != 3) return evaluate_any(piece, c, s, point);
  if (piece.is_rational == 0) return evaluate_cubic(c, 3, s, point);
  evaluate_cubic(c, 4, s, point);
  float w, w1, w2, w3;
  cubic_at(c + 3, 4, s, w, w1, w2, w3);
  divide(point, w, w1, w2, w3);
}

}  // namespace firmtouch::spline
