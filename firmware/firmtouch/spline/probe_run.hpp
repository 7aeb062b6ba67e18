#pragma once
#include "firmtouch/core/hash.hpp"
#include "firmtouch/query/probe_run.hpp"
#include "firmtouch/spline/closest.hpp"
#include "firmtouch/spline/hint.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::spline {

using ProbeQuery = Closest(const View&, math::Vec3, query::Budget, CurveHint&);

/// Adds the bits of an answer to `hash`.
void add_answer(const Closest& answer, core::Hash& hash);

/// What a probe run of spline queries keeps from one query to the next (query/probe_run.hpp).
template <ProbeQuery* kQuery>
struct Prober {
  void answer(const View& model, math::Vec3 p_m, const query::Budget& budget, core::Hash& hash) {
    add_answer(kQuery(model, p_m, budget, hint), hash);
  }
  CurveHint hint;
};

}  // namespace firmtouch::spline
