#include "bake/asset/origin.hpp"

#include <algorithm>
#include <cmath>

#include "firmtouch/asset/layout.hpp"
#include "firmtouch/mesh/layout.hpp"

namespace firmtouch::tools {
namespace {

constexpr int kFractionBits = 3;  // of the diagonal: how near to the middle

// Half a unit in the last place of a float32 coordinate.
double half_unit_m(double a_m, double b_m) {
  const double reach_m = std::max(std::fabs(a_m), std::fabs(b_m));
  return reach_m > 0 ? std::ldexp(1.0, std::ilogb(reach_m) - 24) : 0;
}

}  // namespace

Point origin_for(Point low_m, Point high_m) {
  const double diagonal_m = length(high_m - low_m);
  const double rounding_m = length({half_unit_m(low_m.x, high_m.x), half_unit_m(low_m.y, high_m.y),
                                    half_unit_m(low_m.z, high_m.z)});
  const Point middle = (low_m + high_m) * 0.5;
  const double reach_m =
      std::fabs(middle.x) + std::fabs(middle.y) + std::fabs(middle.z) + diagonal_m;
  const bool is_held = rounding_m <= static_cast<double>(mesh::kMaxRounding) * diagonal_m;
  if (is_held || !(diagonal_m > 0) || !(reach_m <= static_cast<double>(asset::kMaxOrigin_m)))
    return {};
  const double unit_m = std::ldexp(1.0, std::ilogb(diagonal_m) - kFractionBits);
  const auto rounded = [&](double x_m) {
    return static_cast<double>(static_cast<float>(std::round(x_m / unit_m) * unit_m));
  };
  return {rounded(middle.x), rounded(middle.y), rounded(middle.z)};
}

bool is_moved(Point origin_m) { return dot(origin_m, origin_m) > 0; }

Section origin_section(Point origin_m) {
  const math::Vec3 stored_m = to_vec3(origin_m);
  return make_section(asset::kOriginSection, "origin", &stored_m, 1);
}

}  // namespace firmtouch::tools
