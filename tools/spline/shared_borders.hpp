#pragma once
#include <cstddef>
#include <map>
#include <utility>
#include <vector>

#include "spline/spline.hpp"

namespace firmtouch::tools {

/// Places where the borders of two surfaces lie on each other, each gone along with its surface to
/// the left as its normal (u x v) shows it: in how many they run the same way, and against each
/// other.
struct BorderVotes {
  int along = 0, against = 0;
};

struct SharedBorders {
  std::map<std::pair<size_t, size_t>, BorderVotes> votes;  // by surfaces, the lower first
  // Of each surface: more than a quarter of one of its borders is shared with none, or with two.
  std::vector<bool> is_open;
};

/// Borders are compared as places, within 2e-5 of the extent, not by their parameters: one may lie
/// on a part of another. Pre: there are surfaces.
SharedBorders shared_borders(const SplineModel& model);

}  // namespace firmtouch::tools
