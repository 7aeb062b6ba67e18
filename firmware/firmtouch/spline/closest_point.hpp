#pragma once
#include <stdint.h>

#include "firmtouch/core/hash.hpp"
#include "firmtouch/query/certificate.hpp"
#include "firmtouch/query/probe.hpp"
#include "firmtouch/spline/hint.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::spline {

struct Closest {
  float distance_m = 0;
  math::Vec3 point_m;    // on the curve or surface
  math::Vec3 direction;  // unit: a curve's tangent, a surface's normal (along u x along v, or
                         // against it where the baker turned it over); 0 where there is none
  uint32_t piece = 0;    // the entity, in the order of the file
  float u = 0, v = 0;    // in the entity's own parameters; v = 0 for a curve
  uint32_t bezier = 0;   // the piece of the asset, and where on it, -1 to 1
  float s = 0, t = 0;
  uint32_t evaluations = 0;        // of the curve or surface, counted in certificate.steps too
  query::Certificate certificate;  // sign: always 0
};

/// Closest point of all the model's curves or surfaces to `p_m` (model frame): always the global one,
/// found by branch and bound over parts of Bezier pieces, from the part of the hint where it is warm.
/// A part is done with when a second-order expansion at one of its points, with a bound of its third
/// derivative, proves that no point of it is nearer; parts for which it does not are halved.
/// Pre:    `model` is open.
/// Bounds: <= budget steps, a step being a node read or a point evaluated; 8 KB of stack;
///         re-entrant; callable from an interrupt.
/// Result: always finite. Two points equally near: the one found first. Unlimited queries are exact but for
///         a rare one within 2e-7 extents of a surface, which says so after many steps. A query that is not
///         finite: some point, at distance FLT_MAX, lower 0, not exact.
/// Error:  distance and, where exact, lower bound within 4e-7 of the extent (rational: 1e-6) and 9e-7
///         of the distance of the truth (tests/spline/closest_point_host_test.cpp).
Closest closest_point(const View& model, math::Vec3 p_m, query::Budget budget, Hint& hint);
/// The same without a front: of a surface more steps along a path.
Closest closest_point(const View& model, math::Vec3 p_m, query::Budget budget, CurveHint& hint);

/// The same of curves alone, in less stack. Pre: `model` has no surfaces.
Closest closest_on_curve(const View& model, math::Vec3 p_m, query::Budget budget, CurveHint& hint);

/// Probe queries one after the other with one hint, each in a slice of its own.
class ProbeRun {
 public:
  ProbeRun() = default;
  explicit ProbeRun(const query::Probes& probes) : probes_(probes) {}
  /// Asks the next one.
  void work(const View& model);
  bool done() const { return next_ >= probes_.points.size(); }
  bool agrees() const { return hash_.value() == probes_.hash; }

 private:
  query::Probes probes_;
  core::Hash hash_;
  CurveHint hint_;
  uint32_t next_ = 0;
};

/// Hash of the bits of what closest_point() answers to `points`, one after the other with one hint.
uint64_t probe_hash(const View& model, core::Span<const query::ProbePoint> points);

}  // namespace firmtouch::spline
