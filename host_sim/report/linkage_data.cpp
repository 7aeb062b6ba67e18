#include "host_sim/report/linkage_data.hpp"

#include <vector>

#include "json/json.hpp"

namespace firmtouch::host_sim {
namespace {

using tools::Json;

constexpr double kQuarter_rad = 1.5707963267948966;

std::string vector_text(Vec v) {
  return tools::json_list(std::vector<double>{v.x, v.y, v.z}, tools::json_number);
}

std::string range_of(const LinkageDevice& device, uint32_t joint) {
  const device::JointSetting& of = device.joints.joint[joint];
  return tools::json_list(std::vector<float>{of.low_rad, of.high_rad},
                          [](float angle_rad) { return tools::json_number(double{angle_rad}); });
}

// `joint` drives the chain. Where its link points at 0 and at a quarter turn is its plane.
std::string chain_of(const LinkageDevice& device, uint32_t chain, uint32_t joint) {
  const std::vector<tools::Link> links = tools::links_of(device);
  const double length_m = links[chain].length_m;
  JointMotion at;
  const Vec base_m = points_of(device, at).base[chain].at_m;
  const Vec out_m = points_of(device, at).elbow[chain].at_m - base_m;
  at.angle_rad[joint] = kQuarter_rad;
  const Vec up_m = points_of(device, at).elbow[chain].at_m - base_m;
  return Json()
      .add("base", vector_text(base_m))
      .add("out", vector_text(out_m * (1 / length_m)))
      .add("up", vector_text(up_m * (1 / length_m)))
      .add("link", length_m)
      .add("rod", links[links.size() / 2 + chain].length_m)
      .add("range", range_of(device, joint))
      .object();
}

}  // namespace

std::string linkage_data_of(const LinkageDevice& device) {
  const auto* const arm = std::get_if<device::SerialArm>(&device.linkage);
  const auto* const bar = std::get_if<device::FiveBar>(&device.linkage);
  const auto* const delta = std::get_if<device::Delta>(&device.linkage);
  const uint32_t joints = device.joints.joints;
  std::string chains;
  for (uint32_t k = 0; k < (arm != nullptr ? 1 : joints); ++k)
    chains += (k == 0 ? "" : ", ") + chain_of(device, k, arm != nullptr ? joints - 2 : k);
  const bool is_positive =
      (bar != nullptr && bar->is_tip_left) || (delta != nullptr && delta->is_tip_above);
  return Json()
      .add("chains", "[" + chains + "]")
      .add("turntable", arm != nullptr && joints == 3 ? range_of(device, 0) : "null")
      .add("second", arm != nullptr ? range_of(device, joints - 1) : "null")
      .add("isRelative", arm != nullptr && !arm->has_parallelogram)
      .add("side", arm != nullptr ? 0.0
                   : is_positive  ? 1.0
                                  : -1.0)
      .object();
}

}  // namespace firmtouch::host_sim
