#pragma once
#include "firmtouch/hull/view.hpp"
#include "firmtouch/query/probe_run.hpp"

namespace firmtouch::hull {

/// Probe queries of a hull: the closest point of the base hull, and the first crossing of base hull
/// and mesh on the way from the previous point, the first time from the origin.
struct Prober {
  void answer(const View& hull, math::Vec3 p_m, const query::Budget& budget, core::Hash& hash);
  math::Vec3 from_m;
};
using ProbeRun = query::ProbeRun<Prober>;

/// Hash of the bits of the answers to `points`.
uint64_t probe_hash(const View& hull, core::Span<const query::ProbePoint> points);

}  // namespace firmtouch::hull
