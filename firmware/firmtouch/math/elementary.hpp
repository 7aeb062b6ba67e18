#pragma once

// Elementary functions in float32, of + - * / and integer operations only: the same bits on every
// target, no libm. All are total and finite. Bounds are in ulp of the result, against double, over
// every float of the range unless it says otherwise (tests/math/elementary_host_test.cpp).
namespace firmtouch::math {

/// Of an angle in radians, any float: the reduction is exact (2/pi to 224 bits). 1.5 ulp. NaN,
/// infinity: 0.
/// Bounds: about 150 instructions, 64-bit products included.
float sine(float angle_rad);

/// As sine. 1.5 ulp. NaN, infinity: 1.
float cosine(float angle_rad);

/// Angle of the point (x, y), -pi to pi; 3 ulp where it is at least FLT_MIN, else within 2^-149.
/// Signed zeros as in C; an infinity counts as farther than every number, two of them as equal.
/// NaN: 0.
/// Bounds: two divisions, about 90 instructions.
float arc_tangent2(float y, float x);

/// 0 to pi; 1.5 ulp. Beyond -1 and 1: as at -1 and 1. NaN: pi / 2.
/// Bounds: one square root, about 55 instructions.
float arc_cosine(float cosine);

/// e^-x of x from 0 to 16, within 4e-6. Beyond, NaN: 0.
/// Bounds: one division, about 30 instructions.
float decay(float x);

/// Correctly rounded. Negative, NaN: 0. Infinity: the largest float.
float safe_square_root(float value);

}  // namespace firmtouch::math
