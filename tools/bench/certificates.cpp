#include "bench/certificates.hpp"

#include <algorithm>
#include <limits>

namespace firmtouch::bench {
namespace {

constexpr uint32_t kUnlimited = std::numeric_limits<uint32_t>::max();
constexpr double kUpperSlack =
    4e-7;  // of max(diagonal, truth): what float32 may lose of a distance
constexpr double kOracleRounding = 1e-12;  // relative
constexpr double kGapRounding = 0x1p-23;   // of the distance: a gap is a difference of two floats

}  // namespace

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double at = share * static_cast<double>(values.size());
  return values[std::min(values.size() - 1, static_cast<size_t>(at))];
}

CertificateCounts count_certificates(const std::vector<double>& truths_m, double diagonal_m,
                                     const BudgetQuery& query) {
  CertificateCounts counts;
  for (size_t i = 0; i < truths_m.size(); ++i)
    counts.worst_steps = std::max(counts.worst_steps, query(i, kUnlimited).steps);
  std::vector<uint32_t> budgets;
  for (uint32_t budget = 1; budget < counts.worst_steps; budget *= 2) budgets.push_back(budget);
  budgets.push_back(counts.worst_steps);
  budgets.push_back(kUnlimited);
  for (size_t i = 0; i < truths_m.size(); ++i) {
    const double truth_m = truths_m[i];
    double gap_m = std::numeric_limits<double>::infinity();
    for (const uint32_t budget : budgets) {
      const Reported reported = query(i, budget);
      ++counts.queried;
      if (!(reported.lower_m <= truth_m * (1 + kOracleRounding))) ++counts.lower_wrong;
      const double slack_m = kUpperSlack * std::max(diagonal_m, truth_m);
      if (!(reported.upper_m >= truth_m - slack_m)) ++counts.upper_wrong;
      const double now_m = reported.upper_m - reported.lower_m;
      // Two exact answers may be of two triangles equally near.
      const bool is_exact = now_m <= slack_m;
      if (!(is_exact || now_m <= gap_m + kGapRounding * reported.upper_m)) ++counts.gap_grew;
      gap_m = now_m;
    }
  }
  std::vector<double> gaps_m;
  for (size_t i = 0; i < truths_m.size(); ++i) {
    const Reported reported = query(i, std::max(1u, counts.worst_steps / 2));
    gaps_m.push_back(reported.upper_m - reported.lower_m);
  }
  counts.half_gap_m = quantile(gaps_m, 0.5);
  return counts;
}

BoundShares bound_shares(const std::vector<double>& truths_m, uint32_t budget,
                         const BudgetQuery& query) {
  std::vector<double> lower, upper;
  size_t done = 0;
  for (size_t i = 0; i < truths_m.size(); ++i) {
    const Reported reported = query(i, budget);
    const double truth_m = std::max(truths_m[i], 1e-300);
    lower.push_back(reported.lower_m / truth_m);
    upper.push_back(reported.upper_m / truth_m);
    if (query(i, kUnlimited).steps <= budget) ++done;
  }
  return {quantile(lower, 0.5), quantile(lower, 0.1), quantile(upper, 0.9),
          static_cast<double>(done) / static_cast<double>(truths_m.size())};
}

}  // namespace firmtouch::bench
