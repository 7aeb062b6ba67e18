#pragma once
#include <cstdint>
#include <vector>

#include "surface/box_tree.hpp"
#include "surface/surface.hpp"

namespace firmtouch::tools {

/// Pairs of faces that may meet elsewhere than in their common vertices: all that do, few others.
/// Bounds: O(n log n + pairs of overlapping boxes); faces about one vertex count by their
///         directions from it.
class NearFaces {
 public:
  explicit NearFaces(const Surface& surface);

  /// Sets `near` to the faces above `f` that may meet it, in a fixed order.
  void above(uint32_t f, std::vector<uint32_t>& near) const;
  /// The same in two steps. Sets `near` to the faces whose boxes come within `margin_m` of that of
  /// `f`, in a fixed order; of many about one vertex some may lack. Then keeps those above `f` that
  /// may meet it.
  void within(uint32_t f, double margin_m, std::vector<uint32_t>& near) const;
  void keep_above(uint32_t f, std::vector<uint32_t>& near) const;

 private:
  // Many faces about one vertex, the hub. Their boxes all overlap there. Their directions from it
  // overlap only where they may meet elsewhere, too.
  struct Star {
    uint32_t hub;
    std::vector<uint32_t> faces;
    BoxTree boxes, directions;
  };

  Box box_of(uint32_t f) const;
  Box directions_of(uint32_t f, uint32_t hub) const;
  void gather_stars();

  const Surface& surface_;
  std::vector<Star> stars_;
  std::vector<uint32_t> star_of_, loose_;  // of each face, kNone: none; faces of none
  BoxTree tree_;                           // of the loose faces, then of the stars
  mutable std::vector<uint32_t> found_;
};

}  // namespace firmtouch::tools
