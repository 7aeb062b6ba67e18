#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "surface/surface.hpp"

namespace firmtouch::tools {

struct CheckOptions {
  // --unsigned: distance without inside and outside; the surface need not be closed.
  bool allow_unsigned = false;
  // --close-holes: each hole gets a cap of triangles (surface/close_holes.hpp).
  bool close_holes = false;
  // --mend: all of the above, and vertices near each other are welded, dangling faces removed and
  // sheets that share an edge or a vertex parted.
  bool mend = false;
};

/// What check_and_mend() did and found, one sentence each: what, how often, where first (indices
/// from 0 in the file's order), and for a refusal how to mend it. The caller puts the file's name
/// before it.
struct CheckReport {
  std::vector<std::string> mended;
  std::vector<std::string> refused;     // empty: the surface may be baked
  std::vector<std::string> kept;        // defects that --unsigned lets through
  std::vector<uint32_t> vertex_source;  // of each vertex left: its index in the file
  bool is_closed = false;               // closed, manifold, outward: inside and outside are defined

  bool usable() const { return refused.empty(); }
};

/// Checks a surface as a reader gave it and mends what is safe: unused vertices, duplicate faces,
/// vertices whose duplicates tear it open, faces without area, faces wound against the rest, shells
/// wound inside out. Vertices keep their coordinates, faces their order and `source`.
/// Bounds: O(n log n) time, no recursion.
CheckReport check_and_mend(Surface& surface, const CheckOptions& options);

}  // namespace firmtouch::tools
