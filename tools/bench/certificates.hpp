#pragma once
#include <cstdint>
#include <functional>
#include <vector>

namespace firmtouch::bench {

/// What a query returned: |distance| (an upper bound of the truth), certified lower bound, steps
/// taken.
struct Reported {
  double upper_m = 0, lower_m = 0;
  uint32_t steps = 0;
};

/// The query number `i` under a budget of so many steps.
using BudgetQuery = std::function<Reported(size_t i, uint32_t budget)>;

struct CertificateCounts {
  size_t queried = 0;      // answers compared
  size_t lower_wrong = 0;  // lower > truth
  size_t upper_wrong = 0;  // upper < truth - 4e-7 max(diagonal, truth)
  size_t gap_grew = 0;     // a larger budget left a wider gap, and one that is not exact
  uint32_t worst_steps = 0;
  double half_gap_m = 0;  // median gap at half the worst
};

/// Runs every query under budgets of 1, 2, 4, ... steps up to the worst that any needs unlimited,
/// and unlimited, and compares with `truths_m`.
CertificateCounts count_certificates(const std::vector<double>& truths_m, double diagonal_m,
                                     const BudgetQuery& query);

/// How good the bounds are under one budget, as shares of the truth.
struct BoundShares {
  double lower_median = 0, lower_p10 = 0, upper_p90 = 0;
  double exact = 0;  // share of queries that were done within the budget
};
BoundShares bound_shares(const std::vector<double>& truths_m, uint32_t budget,
                         const BudgetQuery& query);

/// The value below which a share of the values lies (0.5: the median).
double quantile(std::vector<double> values, double share);

}  // namespace firmtouch::bench
