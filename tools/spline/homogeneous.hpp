#pragma once
#include "spline/spline.hpp"

namespace firmtouch::tools {

/// A control point with its weight multiplied in, where knot insertion is affine.
struct Homogeneous {
  double x = 0, y = 0, z = 0, w = 1;
};

/// `weighs`: the weights of the entity differ. Where they do not they are left aside, so that no
/// rounding of theirs comes in.
inline Homogeneous homogeneous(const ControlPoint& p, bool weighs) {
  return weighs ? Homogeneous{p.x * p.w, p.y * p.w, p.z * p.w, p.w} : Homogeneous{p.x, p.y, p.z, 1};
}
inline ControlPoint control_point(const Homogeneous& h, bool weighs) {
  return weighs ? ControlPoint{h.x / h.w, h.y / h.w, h.z / h.w, h.w}
                : ControlPoint{h.x, h.y, h.z, 1};
}

/// The affine combination that is `a` at `low` and `b` at `high`, exactly so at both.
inline Homogeneous between(const Homogeneous& a, const Homogeneous& b, double at, double low,
                           double high) {
  const double right = (at - low) / (high - low), left = (high - at) / (high - low);
  return {left * a.x + right * b.x, left * a.y + right * b.y, left * a.z + right * b.z,
          left * a.w + right * b.w};
}

}  // namespace firmtouch::tools
