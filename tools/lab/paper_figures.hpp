#pragma once
#include <vector>

#include "lab/reference_normals.hpp"
#include "surface/surface.hpp"

namespace firmtouch::lab {

/// A counterexample of Baerentzen & Aanaes 2005 as a closed mesh: `query` is outside of it, its
/// closest point is vertex 0, and by the pseudonormal named it is inside.
struct PaperFigure {
  const char* name;
  NormalKind fails;
  tools::Surface surface;
  tools::Point query;
};

/// Figures 2 to 6.
std::vector<PaperFigure> paper_figures();

/// A wedge, apex vertex 0 at the origin, one of whose three sides is cut into `cuts` + 1 triangles
/// about the apex; the corners that part them are `radius` (at most 0.8) from it.
/// Pre: cuts >= 1.
tools::Surface cut_wedge(uint32_t cuts, double radius);

/// The tent of figure 6: apex vertex 0 at the origin, all below z = 0; its upper side almost a
/// line, `thickness` wide, over two that face down and drop by `drop`.
tools::Surface flat_tent(double thickness, double drop);

}  // namespace firmtouch::lab
