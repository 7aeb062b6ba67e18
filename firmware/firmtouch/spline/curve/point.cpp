#include "firmtouch/spline/curve/point.hpp"

namespace firmtouch::spline {
namespace {

using math::Vec3;

/// One power more of a polynomial with its first derivative, half its second and a sixth of its
/// third (Horner).
template <class T>
void add_power(Jet<T>& jet, T c, float s) {
  jet.d3 = jet.d3 * s + jet.d2;
  jet.d2 = jet.d2 * s + jet.d1;
  jet.d1 = jet.d1 * s + jet.x;
  jet.x = jet.x * s + c;
}

// Numerator over weight, with the derivatives of both (Leibniz' rule).
CurvePoint divided(CurvePoint p, const Jet<float>& w) {
  const float per_w = 1.0f / w.x;
  p.x = p.x * per_w;
  p.d1 = (p.d1 - p.x * w.d1) * per_w;
  p.d2 = (p.d2 - p.d1 * (2.0f * w.d1) - p.x * w.d2) * per_w;
  p.d3 = (p.d3 - p.d2 * (3.0f * w.d1) - p.d1 * (3.0f * w.d2) - p.x * w.d3) * per_w;
  return p;
}

}  // namespace

CurvePoint evaluate(const Piece& piece, const float* coefficients, float s) {
  const float* c = coefficients + piece.coefficients;
  const bool is_rational = piece.is_rational != 0;
  const uint32_t stride = is_rational ? 4 : 3;
  if (piece.degree_u == 3) {
    const CurvePoint point = cubic_at(c, stride, s);
    return is_rational ? divided(point, cubic_at(c[3], c[7], c[11], c[15], s)) : point;
  }
  c += piece.degree_u * stride;
  CurvePoint jet{vec3_at(c), {}, {}, {}};
  Jet<float> weight{is_rational ? c[3] : 1.0f, 0.0f, 0.0f, 0.0f};
  for (uint32_t k = piece.degree_u; k > 0; --k) {
    c -= stride;
    add_power(jet, vec3_at(c), s);
    if (is_rational) add_power(weight, c[3], s);
  }
  jet.d2 = jet.d2 * 2.0f, weight.d2 = weight.d2 * 2.0f;
  jet.d3 = jet.d3 * 6.0f, weight.d3 = weight.d3 * 6.0f;
  return is_rational ? divided(jet, weight) : jet;
}

}  // namespace firmtouch::spline
