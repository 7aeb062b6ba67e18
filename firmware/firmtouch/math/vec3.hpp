#pragma once

namespace firmtouch::math {

/// Three floats; what they mean (metres, newtons, which frame) is in the name of the variable. No
/// arithmetic here: a public header that computes would do so under the user's flags
/// (math/vec3_ops.hpp is for the library's own units).
struct Vec3 {
  float x = 0;
  float y = 0;
  float z = 0;
};

/// Rows of a 3 x 3 matrix.
struct Mat3 {
  Vec3 row[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
};

/// x -> rotation * x + translation_m. The rotation is orthonormal (its maker checks).
struct RigidTransform {
  Mat3 rotation;
  Vec3 translation_m;
};

/// x -> x + translation_m: a RigidTransform that turns nothing, with the same bits.
struct Translation {
  Vec3 translation_m;
};

}  // namespace firmtouch::math
