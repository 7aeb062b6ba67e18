#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "lab/orders/orders.hpp"

namespace firmtouch::lab::orders {

/// One combination of boxes, order and upper bound, over one mesh.
struct Entrant {
  std::string kind, order, upper;
  double tree_bytes;  // nodes, and what the upper bound needs beside them
  std::function<Nearest(Vec3)> nearest;
  /// All points in turn; result: a sum of the distances.
  std::function<double(const std::vector<Vec3>&)> pass;
  std::function<Counters(const std::vector<Vec3>&)> count;  // sums; max_pending: the most
};

/// Every combination over one mesh, which must stay.
/// Pre: the mesh has more than one triangle.
class Contest {
 public:
  explicit Contest(const mesh::View& mesh);
  Contest(const Contest&) = delete;
  Contest& operator=(const Contest&) = delete;

  const std::vector<Entrant>& entrants() const { return entrants_; }

 private:
  struct Forest;
  std::shared_ptr<Forest> forest_;
  std::vector<Entrant> entrants_;
};

}  // namespace firmtouch::lab::orders
