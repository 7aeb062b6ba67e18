// Coordinates computed side by side, where the processor has lanes, have the bits of those computed in turn.
#include <cstring>
#include <vector>

#include "firmtouch/spline/evaluation.hpp"
#include "harness/test.hpp"
#include "surface/random.hpp"

namespace {

namespace math = firmtouch::math;
namespace spline = firmtouch::spline;
namespace tools = firmtouch::tools;

float between(tools::Random& random, double low, double high) {
  return static_cast<float>(random.between(low, high));
}

}  // namespace

TEST(CoordinatesSideBySideHaveTheBitsOfThoseInTurn) {
  tools::Random random(5);
  uint32_t differ = 0, finite = 0, compared = 0;
  for (uint32_t i = 0; i < 4000; ++i) {
    spline::Piece piece{};
    const bool is_bicubic = i % 2 == 0;
    piece.degree_u = static_cast<uint8_t>(is_bicubic ? 3 : 1 + random.below(spline::kMaxDegree));
    piece.degree_v = static_cast<uint8_t>(is_bicubic ? 3 : 1 + random.below(spline::kMaxDegree));
    piece.is_rational = static_cast<uint8_t>(random.below(2));
    piece.coefficients = static_cast<uint32_t>(random.below(3));
    std::vector<float> coefficients(piece.coefficients);
    for (int k = 0; k < (piece.degree_u + 1) * (piece.degree_v + 1); ++k) {
      for (int c = 0; c < 3; ++c) coefficients.push_back(between(random, -1, 1));
      if (piece.is_rational != 0)
        coefficients.push_back(k == 0 ? 1.0f : between(random, -0.02, 0.02));
    }
    const float s = i % 7 == 0 ? -1.0f : between(random, -1, 1);
    const float t = i % 11 == 0 ? 1.0f : between(random, -1, 1);
    spline::SurfacePoint each, together;
    spline::evaluate_each(piece, coefficients.data(), s, t, each);
    spline::evaluate_together(piece, coefficients.data(), s, t, together);
    const float *const a = &each.x.x, *const b = &together.x.x;
    for (uint32_t k = 0; k < 30; ++k) {
      ++compared;
      if (math::bits_of(a[k]) != math::bits_of(b[k])) ++differ;
      if (a[k] - a[k] <= 0.0f) ++finite;
    }
  }
  CHECK_EQ(differ, 0u);
  CHECK_EQ(finite, compared);
}
