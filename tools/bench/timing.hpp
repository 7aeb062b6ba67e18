#pragma once
#include <cstddef>
#include <functional>
#include <vector>

namespace firmtouch::bench {

constexpr size_t kPasses = 5;

/// Who takes part in a comparison: runs all its queries once, on this thread, and says how long
/// that took, in microseconds a query.
using Contender = std::function<double()>;

/// `pass` runs `queries` queries (at least 1) and gives a sum of their answers, so that none is
/// optimised away. It counts this thread's processor time, as the peers do: what else runs on the
/// machine takes none of it.
Contender timed(size_t queries, const std::function<double()>& pass);

/// The median of kPasses passes in a row: what a peer reports of itself in one turn. One pass alone
/// would begin where the other's process has left the caches.
Contender median_of_passes(const Contender& contender);

/// Runs the contenders in turn, kPasses times each, so that what disturbs the machine disturbs all.
/// Result: the median of each, in microseconds a query.
std::vector<double> medians_us(const std::vector<Contender>& contenders);

}  // namespace firmtouch::bench
