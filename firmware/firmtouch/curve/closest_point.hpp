#pragma once
#include <stdint.h>

#include "firmtouch/curve/hint.hpp"
#include "firmtouch/curve/view.hpp"
#include "firmtouch/query/certificate.hpp"
#include "firmtouch/query/probe_run.hpp"

namespace firmtouch::curve {

struct Closest {
  float distance_m = 0;
  math::Vec3 point_m;              // on the curve
  math::Vec3 tangent;              // unit, along the segment, in the order of the samples
  uint32_t segment = 0;            // from sample `segment` to the next
  float arc = 0;                   // of the point: fraction of the curve's length, 0 to 1
  query::Certificate certificate;  // sign: always 0, a curve has no inside
};

/// Closest point of the polyline (not of its samples) to `p_m` (curve frame), with a certificate:
/// from the segment of the hint where it is warm and up the tree of runs, else down it, nearest box
/// first.
/// Pre:    `curve` is open.
/// Bounds: <= budget.work units; 1.8 KB of stack, of a smooth curve 2.6 KB; re-entrant; callable
///         from an interrupt.
/// Result: always finite. Two points equally near: the one found first. A query that is not finite:
///         the first sample, at distance FLT_MAX, lower 0, not exact.
/// Error:  distance and, where exact, lower bound within 4e-7 max(diagonal, distance) of the truth;
///         of a smooth curve within 1e-6 of that and 8e-6 of the longest piece
///         (tests/curve/closest_point_host_test.cpp).
/// Source: Morris 2006, section 2.2; a tree of all segments instead of N nearest samples, which can
///         miss (tests/curve/paper_test.cpp). Ballard 1981 (strips about chords).
Closest closest_point(const View& curve, math::Vec3 p_m, query::Budget budget, Hint& hint);

/// Probe queries, one after the other with one hint.
struct Prober {
  void answer(const View& curve, math::Vec3 p_m, const query::Budget& budget, core::Hash& hash);
  Hint hint;
};
using ProbeRun = query::ProbeRun<Prober>;

/// Hash of the bits of the answers to `points`.
uint64_t probe_hash(const View& curve, core::Span<const query::ProbePoint> points,
                    query::Budget budget = query::kProbeBudget);

}  // namespace firmtouch::curve
