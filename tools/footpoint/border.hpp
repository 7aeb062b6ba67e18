#pragma once
#include <array>
#include <vector>

#include "spline/spline.hpp"

namespace firmtouch::tools {

/// An edge of a patch, and where it runs through the surface's parameters.
struct Border {
  BezierCurve curve;  // t from 0 to 1
  double u0, v0, u1, v1;
  size_t patch;
  int side;  // 0: v = v0, 1: v = v1, 2: u = u0, 3: u = u1
};

/// What goes on smoothly over an edge.
struct Neighbour {
  static constexpr size_t kNone = static_cast<size_t>(-1);
  size_t patch = kNone;
  int side = 0;
  bool is_turned = false;  // its edge runs the other way
};

struct Corner {
  Point at;
  int piece;
  double u, v;
};

/// An edge over which another patch goes on smoothly.
struct Joint {
  Border border;
  Neighbour over;
};

/// `borders`: the edges of patches over which no other patch goes on smoothly; `corners`: where
/// they end or turn, edges that are a single point among them. `joints`: the other edges, each
/// once. `neighbours`: over each side of each patch. `gap`: as of Footpoints.
void find_borders(const std::vector<BezierPatch>& patches, double gap, double extent_m,
                  std::vector<Border>& borders, std::vector<Corner>& corners,
                  std::vector<Joint>& joints, std::vector<std::array<Neighbour, 4>>& neighbours);

}  // namespace firmtouch::tools
