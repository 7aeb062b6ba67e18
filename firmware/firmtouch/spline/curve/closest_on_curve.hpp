#pragma once
#include "firmtouch/spline/closest.hpp"
#include "firmtouch/spline/hint.hpp"
#include "firmtouch/spline/probe_run.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::spline {

/// Closest point of all curves to `p_m` (model frame): always the global one. Branch and bound over
/// Bezier pieces, from the hint's leaf where it is warm. A leaf is closed where a second-order
/// expansion at one of its points, with bounds of the third and fourth derivatives, proves that no
/// point of it is nearer; else it is halved.
/// Pre:    `model` is open and has curves.
/// Bounds: <= budget.work units, 1 a node read and 4 a point evaluated; 2.2 kB of stack;
///         re-entrant; callable from an interrupt.
/// Result: always finite. Of two points equally near the one found first. Unlimited queries are
///         exact. A query that is not finite returns a point at distance FLT_MAX, lower 0, not
///         exact.
/// Error: distance and, where exact, lower bound within 4e-7 of the extent (rational: 1e-6) and
///         9e-7 of the distance of the truth (tests/spline/closest_point_host_test.cpp).
Closest closest_on_curve(const View& model, math::Vec3 p_m, query::Budget budget, CurveHint& hint);

using CurveProbeRun = query::ProbeRun<Prober<closest_on_curve>>;

}  // namespace firmtouch::spline
