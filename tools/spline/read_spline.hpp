#pragma once
#include <string>
#include <string_view>

#include "spline/spline.hpp"

namespace firmtouch::tools {

/// Reads NURBS from .igs or .iges (IGES 5.3: entities 126 and 128, placed by 124) or Bezier patches
/// from .bpt (Newell's), distinguished by the extension in either case. `unit_m`: metres a unit of
/// the file's coordinates; 0: what the file itself says, .bpt metres.
/// Result: curves and surfaces whose knots, weights and points are checked, degree 1 to 5, each of
/// some length, not empty; or `problem`, which names file, line, entity, count and remedy.
SplineModel read_spline_file(const std::string& path, double unit_m);

/// The same from memory; `path` gives the extension and the name used in messages.
SplineModel read_spline_bytes(std::string_view bytes, const std::string& path, double unit_m);

}  // namespace firmtouch::tools
