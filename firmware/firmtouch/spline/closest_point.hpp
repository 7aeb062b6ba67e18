#pragma once
#include "firmtouch/spline/curve/closest_on_curve.hpp"
#include "firmtouch/spline/probe_run.hpp"
#include "firmtouch/spline/surface/closest_on_surface.hpp"

// Queries for a caller that does not know whether a model has curves or surfaces: it links both
// searches.
namespace firmtouch::spline {

/// Closest point of all the model's curves or surfaces to `p_m` (model frame).
/// Pre, bounds, result, error: as closest_on_curve() and closest_on_surface().
inline Closest closest_point(const View& model, math::Vec3 p_m, query::Budget budget, Hint& hint) {
  return model.is_surface() ? closest_on_surface(model, p_m, budget, hint)
                            : closest_on_curve(model, p_m, budget, hint);
}
/// The same without a frontier: along a path a surface takes more steps.
inline Closest closest_point(const View& model, math::Vec3 p_m, query::Budget budget,
                             CurveHint& hint) {
  return model.is_surface() ? closest_on_surface(model, p_m, budget, hint)
                            : closest_on_curve(model, p_m, budget, hint);
}

using ProbeRun = query::ProbeRun<Prober<static_cast<ProbeQuery*>(closest_point)>>;

/// The hash of the answers to `points`, one after the other with one hint.
inline uint64_t probe_hash(const View& model, core::Span<const query::ProbePoint> points) {
  query::Probes probes;
  probes.points = points;
  ProbeRun run(probes);
  while (!run.done()) run.work(model);
  return run.hash();
}

}  // namespace firmtouch::spline
