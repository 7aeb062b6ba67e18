#pragma once
// For the library's own translation units.

#include "firmtouch/math/isa.hpp"
#include "firmtouch/math/vec3.hpp"

namespace firmtouch::math {

/// The smallest box of some points. Six floats that a constructor sets: as vectors, or with initial
/// values, they are copied in memory where a compiler saves bytes.
struct Extents {
  float low_x, low_y, low_z, high_x, high_y, high_z;

  [[gnu::always_inline]] Extents() {
    low_x = low_y = low_z = 0x1p127f;
    high_x = high_y = high_z = -0x1p127f;
  }
  [[gnu::always_inline]] void take(float x, float y, float z) {
    low_x = smaller(x, low_x), low_y = smaller(y, low_y), low_z = smaller(z, low_z);
    high_x = larger(x, high_x), high_y = larger(y, high_y), high_z = larger(z, high_z);
  }
  Vec3 low() const { return {low_x, low_y, low_z}; }
  Vec3 high() const { return {high_x, high_y, high_z}; }
};

}  // namespace firmtouch::math
