#pragma once
#include <cstdint>
#include <vector>

#include "bake/mesh/pseudonormals.hpp"
#include "bake/mesh/sign_margin.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// The least margin of a stored normal that the baker takes. Less has a needle or a knife's edge so
/// sharp that, near the surface, the rounding of the direction to the query could turn its side.
constexpr double kMinMargin_rad = 3e-4;

/// The margin by which each stored pseudonormal may still turn before it gives a wrong sign for
/// some point whose closest point lies on its feature (Baerentzen & Aanaes 2005, equation 15): what
/// the firmware decodes from the stored values, against the exact surface, in double. Triangles so
/// thin that float32 takes their features for one another must give one sign with all of them.
struct SignProof {
  struct Kind {
    double smallest_rad = 1.5707963267948966;
    std::vector<uint32_t> weak;  // faces, half-edges (3 * face + k), vertices of less than required
  };
  Kind faces, edges, vertices;
  // Faces so thin that float32 may take an edge of theirs for another, which gives another sign.
  // They are weak where that sign is wrong for more than a few queries, or where it also loses
  // their height, by which it separates the edges.
  std::vector<uint32_t> slivers;

  bool holds() const { return faces.weak.empty() && edges.weak.empty() && vertices.weak.empty(); }
};

/// Of features that lie nearer together than this the firmware may take one for the other: what
/// float32 moves a foot in its plane (mesh/loss.hpp) for a query up to a diagonal away.
double confusion_m(const Surface& surface);

/// Features that are not checked: where a surface crosses itself no normal is right. Empty: none.
struct Excused {
  std::vector<bool> faces, edges, vertices;  // edges: each half-edge
};

/// Proves every face, edge (from both of its faces) and vertex. The side of a vertex's points is
/// taken from its edges, not from its pseudonormal.
/// Pre: as make_pseudonormals().
/// Bounds: O(sum of valence^2 log valence).
SignProof prove_signs(const Surface& surface, const ExactNormals& exact,
                      const Pseudonormals& stored, double min_rad, const Excused& excused);

/// Features whose stored side differs from the winding number beside them: where a surface crosses
/// itself both are right in their way. Looked at: for each face its centroid, for each edge its
/// middle, for each vertex the rays to which it may be the closest point, both sides of each.
struct DifferingSides {
  uint32_t compared = 0;                         // features that have points to compare
  std::vector<uint32_t> faces, edges, vertices;  // edges: the lower of the two half-edges
};
DifferingSides compare_with_winding(const Surface& surface, const ExactNormals& exact,
                                    const Pseudonormals& stored);

}  // namespace firmtouch::tools
