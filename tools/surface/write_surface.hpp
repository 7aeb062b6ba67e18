#pragma once
#include <string>
#include <vector>

#include "surface/surface.hpp"

namespace firmtouch::tools {

/// The text of an OBJ file: metres, %.9g, so that reading it gives the same floats.
std::string to_obj(const Surface& surface);

/// The same as the format of the extension `extension` ("obj", "off", "ply", "stl") has it; the
/// last in binary. Result: empty for any other extension.
std::string to_model(const Surface& surface, const std::string& extension);

/// The text of a CSV file with the header x,y,z: metres, %.9g.
std::string to_csv(const std::vector<math::Vec3>& points_m);

/// Writes a file in one go. Result: empty, or the problem; then there is no file.
std::string write_text(const std::string& path, const std::string& text);

}  // namespace firmtouch::tools
