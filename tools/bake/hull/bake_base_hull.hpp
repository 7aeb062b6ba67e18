#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "firmtouch/hull/view.hpp"

namespace firmtouch::tools {

/// Source of a base hull.
struct BaseHullSource {
  hull::Head head{};
  uint32_t cut = 0;
  std::vector<std::array<uint32_t, 3>> faces;  // of ids
  std::vector<uint32_t> triangles;       // of each face: the mesh's triangle that it is, or kNone
  std::vector<uint32_t> numbers;         // of each id
  std::vector<math::Vec3> vertices_m;    // of each number
  const uint8_t* coordinates = nullptr;  // of all collapses
};

/// Empty if it has more vertices than a base hull can number.
std::vector<uint8_t> encode_base_hull(const BaseHullSource& source);

/// The hull of at most `faces` faces of a proven hull, or its coarsest, as the bytes of a base
/// hull: 4-byte aligned words. Empty as above.
std::vector<uint32_t> cut_base_hull(const hull::View& view, uint32_t faces);

}  // namespace firmtouch::tools
