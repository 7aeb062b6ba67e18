#pragma once
#include <cstdint>
#include <map>

#include "firmtouch/math/vec3.hpp"
#include "firmtouch/spline/closest.hpp"
#include "firmtouch/spline/view.hpp"

namespace firmtouch::tools {

/// The most expensive query seen.
struct WorstQuery {
  uint32_t steps = 0, evaluations = 0;
  math::Vec3 at_m;
  bool has_ended = true;  // false: it was stopped, and takes more than that
};

/// Budgets of queries that are only counted: on surfaces that are folded on themselves, or at the
/// centre of a ball, one may take minutes. Where many of them end queries, a tenth of it.
class CountedQueries {
 public:
  static constexpr uint32_t kMaxWork = 60000;

  query::Budget budget() const { return {unended_ < kMany ? kMaxWork : kMaxWork / 10}; }
  void take(const spline::Closest& answer, math::Vec3 at_m);

  /// Those that were stopped: how many, and how many of each entity.
  uint32_t unended() const { return unended_; }
  const std::map<uint32_t, uint32_t>& unended_of() const { return unended_of_; }
  const WorstQuery& worst() const { return worst_; }

 private:
  static constexpr uint32_t kMany = 500;

  uint32_t unended_ = 0;
  std::map<uint32_t, uint32_t> unended_of_;
  WorstQuery worst_;
};

/// Looks where many parts are about equally near (centres of curvature, half-way between points of
/// the shape) and anywhere in the workspace (a quarter of the extent about the box), then ascends
/// from the most expensive points that it saw. Some of those that were stopped may then take 300
/// times the work. Result: the most expensive one, or `seen`. Deterministic. A figure, never a
/// bound.
WorstQuery find_worst(const spline::View& model, const WorstQuery& seen);

/// About how many instructions a Cortex-M7 takes for a query of so many steps, `evaluations` of
/// them leaves that are evaluated: fitted to counts (tools/bench/cortex-m7-spline), within a fifth
/// of expensive queries.
double cortex_m7_instructions(bool is_surface, double steps, double evaluations);

}  // namespace firmtouch::tools
