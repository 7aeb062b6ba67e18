#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "firmtouch/math/vec3.hpp"
#include "surface/file_frame.hpp"

namespace firmtouch::tools {

using Face = std::array<uint32_t, 3>;

/// A triangle mesh in memory: what the readers give, the check mends and the baker takes. Float32
/// metres, outward.
struct Surface {
  std::vector<math::Vec3> vertices;
  std::vector<Face> faces;
  std::vector<uint32_t> source;  // of each face: its index in the imported file (polygons fanned)
  FileFrame frame = {};          // of the file, for messages
};

}  // namespace firmtouch::tools
