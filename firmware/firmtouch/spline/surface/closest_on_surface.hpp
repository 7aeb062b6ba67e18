#pragma once
#include "firmtouch/spline/closest.hpp"
#include "firmtouch/spline/hint.hpp"
#include "firmtouch/spline/probe_run.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::spline {

/// Closest point of all surfaces to `p_m` (model frame): always the global one. Branch and bound
/// over patches, from the hint's leaf where it is warm. A leaf is closed where a second-order
/// expansion at one of its points, with bounds of the third and fourth derivatives, proves that no
/// point of it is nearer; else it is halved.
/// Pre:    `model` is open and has surfaces.
/// Bounds: <= budget.work units, 3 a node read and 24 a point evaluated; 5.3 kB of stack;
///         re-entrant; callable from an interrupt.
/// Result: always finite. Of two points equally near the one found first. Unlimited queries are
///         exact except for a rare one within 2e-7 extents of the surface, which says so after many
///         steps. Beyond budget.band_m an answer is not exact, its lower bound the band less what
///         rounding loses. A query that is not finite returns a point at distance FLT_MAX, lower 0,
///         not exact.
/// Error: distance and, where exact, lower bound within 4e-7 of the extent (rational: 1e-6) and
///         9e-7 of the distance of the truth (tests/spline/closest_point_host_test.cpp).
Closest closest_on_surface(const View& model, math::Vec3 p_m, query::Budget budget, Hint& hint);
/// The same without a frontier: more steps along a path.
Closest closest_on_surface(const View& model, math::Vec3 p_m, query::Budget budget,
                           CurveHint& hint);

using SurfaceProbeRun = query::ProbeRun<Prober<static_cast<ProbeQuery*>(closest_on_surface)>>;

}  // namespace firmtouch::spline
