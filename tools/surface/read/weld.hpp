#pragma once
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// Makes a surface of triangles that stand alone, as STL has them: corners at exactly the same
/// place become one vertex (-0 and 0 are one place), but where separate bodies only touch at that
/// vertex, each has its own. Vertices are numbered as the faces first use them.
/// Pre: every face has its own three vertices, in the order of the faces.
/// Bounds: O(n log n).
void weld_corners(Surface& surface);

}  // namespace firmtouch::tools
