#pragma once
#include <functional>
#include <vector>

#include "bench/timing.hpp"
#include "firmtouch/curve/guided_point.hpp"

namespace firmtouch::bench {

/// One query of a curve: a distance, so that no answer is optimised away.
using Query = std::function<double(math::Vec3)>;

/// A pass over the points; `fresh` makes a query without history.
inline Contender ours(const std::vector<math::Vec3>& points, const std::function<Query()>& fresh) {
  return timed(points.size(), [&points, fresh] {
    double sum = 0;
    const Query query = fresh();
    for (const math::Vec3& p : points) sum += query(p);
    return sum;
  });
}

/// Follows the curve from point to point, each from the arc position of the one before, with a
/// penalty of `weight_m`.
inline std::function<Query()> guided(const curve::View& view, float weight_m) {
  return [&view, weight_m]() -> Query {
    return [&view, weight_m, following = curve::Following{}](math::Vec3 p) mutable {
      const curve::Hold hold{weight_m, 1e9f};
      return static_cast<double>(
          follow(view, p, hold, query::kUnlimited, following).constraint.cost_m);
    };
  };
}

}  // namespace firmtouch::bench
