#pragma once
#include <array>
#include <cstdint>
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
  // By `source`: the material of each triangle of the file; 0, and behind the end: none.
  std::vector<uint8_t> material = {};

  uint8_t material_of(uint32_t face) const {
    const uint32_t of = face < source.size() ? source[face] : face;
    return of < material.size() ? material[of] : uint8_t{0};
  }
  /// Before a face without area is flipped into the area of another one.
  /// Pre: where there are materials, `source` is of all faces.
  void take_material(uint32_t face, uint32_t of) {
    if (material_of(face) != material_of(of)) source[face] = source[of];
  }
};

}  // namespace firmtouch::tools
