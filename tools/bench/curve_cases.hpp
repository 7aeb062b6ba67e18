#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "bake/asset/section.hpp"
#include "bake/curve/bake_curve.hpp"
#include "firmtouch/curve/view.hpp"

namespace firmtouch::bench {

/// A curve baked in memory and opened with the firmware's decoder; the view refers to the sections.
struct CurveCase {
  CurveCase() = default;
  CurveCase(CurveCase&&) = default;
  CurveCase& operator=(CurveCase&&) = default;

  std::string name;
  std::vector<math::Vec3> samples_m;
  tools::CurveReport report;
  double bake_s = 0;  // sections built and proven
  std::vector<tools::Section> sections;
  curve::View view;
};

/// A knot of 0.3 m that passes near itself; `power`: 0 for even spacing, 6 for spacing that varies
/// by a million. The same on every machine.
std::vector<math::Vec3> make_track(uint32_t samples, uint32_t power);

/// Throws a Problem where the curve cannot be baked.
CurveCase bake_case(std::vector<math::Vec3> samples_m, const std::string& name,
                    bool is_smooth = false);

/// Points spread evenly in 1.5 times the curve's box.
std::vector<math::Vec3> random_points(const CurveCase& curve, size_t count);

}  // namespace firmtouch::bench
