#pragma once
#include <vector>

#include "bake/mesh/sign_margin.hpp"
#include "surface/point.hpp"
#include "surface/surface.hpp"

namespace firmtouch::lab {

/// The pseudonormals of a vertex that have been proposed (Baerentzen & Aanaes 2005, section 2.1 and
/// appendix). Only the first two give the right sign always; the rest are here to fail.
enum class NormalKind {
  kAngleWeighted,
  kConvexHull,    // the shortest vector to the convex hull of the tips of the face normals
  kMean,          // Gouraud: the plain sum
  kGlassner,      // of the plane that fits the neighbouring vertices best
  kGlassnerBall,  // the same, of the neighbours drawn to one distance
  kHuang,         // the face normal most along the offset, either way
  kMax,           // cross products over the product of the squared lengths of the two edges
  kMaxAsPrinted,  // over their sum, as the paper has it by a slip
  kUnitCross,     // cross products of unit edges
  kCross          // cross products of the edges
};

struct NamedNormal {
  NormalKind kind;
  const char* name;
};
/// Every kind, in the order above.
const std::vector<NamedNormal>& reference_normals();

/// One face at a vertex: its edges from there, `next` x `last` outward.
struct Corner {
  tools::Point next, last;
};

/// Where the sign of a vertex's pseudonormal is decided, from the corners in order, in double.
std::vector<tools::SideRay> rays_of(const std::vector<Corner>& corners);

/// The corners at each vertex of a closed surface.
std::vector<std::vector<Corner>> corners_of(const tools::Surface& surface);

/// The pseudonormal, of any length, for the offset `r` from the vertex (only Huang's depends on
/// it). A fitted plane has no outside: it is turned as the angle-weighted one lies, which favours
/// it.
tools::Point reference_normal(NormalKind kind, const std::vector<Corner>& corners, tools::Point r);

}  // namespace firmtouch::lab
