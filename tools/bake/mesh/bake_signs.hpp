#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "bake/mesh/pseudonormals.hpp"
#include "bake/mesh/turn_slivers.hpp"
#include "surface/crossings.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// What is known of the signs that an asset will return. Indices are those of the surface given.
struct SignReport {
  // By how much the worst stored normal of each kind may still turn; features where the surface
  // crosses itself are left out.
  double face_margin_rad = 0, edge_margin_rad = 0, vertex_margin_rad = 0;
  Crossings crossings;
  TurnedSlivers turned;

  /// Features whose stored side differs from the winding number.
  struct Differing {
    std::vector<uint32_t> faces, vertices;
    std::vector<std::pair<uint32_t, uint32_t>> edges;  // by their vertices, lower first
    size_t count() const { return faces.size() + vertices.size() + edges.size(); }
  };
  uint32_t compared = 0;             // features; none where the surface does not cross itself
  std::vector<Differing> differing;  // of each of crossings.places, and last of all the rest
};

/// Makes and proves the pseudonormals of a surface whose faces have their longest edges first.
/// Slivers whose edges float32 confuses are turned where that moves the surface by `max_move_m` at
/// most in all (turn_slivers.hpp).
/// Error: `problem` says what, where and how to mend, and is empty where every side will be right.
Pseudonormals bake_signs(Surface& surface, double max_move_m, SignReport& report,
                         std::string& problem);

/// Where the surface crosses itself: the lines of describe(), then by place how many features give
/// another sign than the winding number, and the first few. With indices of the file.
std::vector<std::string> describe(const SignReport& report, const Surface& surface,
                                  const std::vector<uint32_t>& vertex_source);

}  // namespace firmtouch::tools
