#include "host_sim/report/condition_map.hpp"

#include <algorithm>
#include <cmath>

#include "chart/chart.hpp"
#include "host_sim/device/drawn_links.hpp"
#include "host_sim/device/workspace.hpp"
#include "host_sim/report/page_data.hpp"

namespace firmtouch::host_sim {
namespace {

using chart::fixed;

constexpr uint32_t kCells = 120;               // along the longer side
constexpr uint32_t kSteps[] = {0, 0, 60, 12};  // of a joint for the corners, by their number
constexpr double kMargin = 0.03;               // of the workspace
constexpr double kWidth = 620, kHeight = 380;  // pixels, at most
constexpr Colour kOut{150, 158, 170}, kNoForce{198, 40, 57}, kFaded{240, 160, 60};
constexpr Colour kPoor{222, 238, 214}, kBest{20, 110, 74};

Colour colour_of(double reciprocal, const device::TorqueLimits& limits) {
  if (reciprocal < 0) return kOut;
  if (reciprocal <= static_cast<double>(limits.gone_at)) return kNoForce;
  if (reciprocal < static_cast<double>(limits.full_from)) return kFaded;
  const auto mixed = [&](uint8_t from, uint8_t to) {
    return static_cast<uint8_t>(std::lround(from + (to - from) * std::min(1.0, reciprocal)));
  };
  return {mixed(kPoor.r, kBest.r), mixed(kPoor.g, kBest.g), mixed(kPoor.b, kBest.b)};
}

std::string key(Colour colour, const std::string& text) {
  return "<label><i style=\"background:" + hex_of(colour) + ";height:12px\"></i>" + text +
         "</label>";
}

}  // namespace

Vec ConditionMap::middle_m(uint32_t column, uint32_t row) const {
  return {low_m.x + (high_m.x - low_m.x) * (column + 0.5) / columns,
          high_m.y - (high_m.y - low_m.y) * (row + 0.5) / rows, low_m.z};
}

ConditionMap condition_map(const LinkageDevice& device, double z_m) {
  const Workspace space = workspace_of(device, kSteps[device.joints.joints]);
  const double width = space.high_m.x - space.low_m.x, height = space.high_m.y - space.low_m.y;
  const double margin = kMargin * std::max(width, height);
  ConditionMap map;
  if (!(std::max(width, height) > 0)) return map;  // no pose of the grid is reachable
  map.low_m = {space.low_m.x - margin, space.low_m.y - margin, z_m};
  map.high_m = {space.high_m.x + margin, space.high_m.y + margin, z_m};
  const double cell = (std::max(width, height) + 2 * margin) / kCells;
  map.columns = static_cast<uint32_t>(std::lround((width + 2 * margin) / cell));
  map.rows = static_cast<uint32_t>(std::lround((height + 2 * margin) / cell));
  TipFollower tip(device);
  for (uint32_t row = 0; row < map.rows; ++row)
    for (uint32_t column = 0; column < map.columns; ++column) {
      const JointMotion* at = tip.at(map.middle_m(column, row));
      map.reciprocal.push_back(at != nullptr ? reciprocal_condition(device, *at) : -1);
    }
  return map;
}

std::string condition_card(const LinkageDevice& device, const RunPaths& run) {
  const bool is_planar = device.joints.joints == 2;
  const ConditionMap map = condition_map(device, is_planar ? 0 : run.peak_device_m().z);
  if (map.reciprocal.empty()) return "";
  Image image(map.columns, map.rows, kOut);
  for (size_t i = 0; i < map.reciprocal.size(); ++i)
    image.pixels[i] = colour_of(map.reciprocal[i], device.limits);
  const std::string png = png_of(image);
  const Vec size = map.high_m - map.low_m;
  const double scale = std::min(kWidth / size.x, kHeight / size.y);
  const double width = scale * size.x, height = scale * size.y;
  const auto place = [&](const Vec& p) {
    return fixed((p.x - map.low_m.x) * scale, 1) + "," + fixed((map.high_m.y - p.y) * scale, 1);
  };
  std::string way;
  for (size_t i = run.first(); i < run.samples().size(); i += 1 + run.samples().size() / 1500)
    way += (way.empty() ? "" : " ") + place(run.samples()[i].device_m);
  const auto range = [](const char* axis, double low_m, double high_m) {
    return std::string(axis) + " from " + fixed(low_m * 1e3, 0) + " to " + fixed(high_m * 1e3, 0) +
           " mm";
  };
  const std::string full_from = fixed(static_cast<double>(device.limits.full_from), 2);
  return "<section class=\"card\" id=\"condition\"><h2>Condition over the workspace</h2><p>"
         "Reciprocal condition of each place of the tip: " +
         range("x", map.low_m.x, map.high_m.x) + " (right), " +
         range("y", map.low_m.y, map.high_m.y) + " (up)" +
         (is_planar ? ""
                    : ", at z = " + fixed(map.low_m.z * 1e3, 1) +
                          " mm, the height of the largest force") +
         ". Dark line: the way of the tool.</p><svg viewBox=\"0 0 " + fixed(width, 1) + " " +
         fixed(height, 1) + "\" width=\"" + fixed(width, 0) +
         "\" role=\"img\" aria-label=\"map of the condition\"><image width=\"" + fixed(width, 1) +
         "\" height=\"" + fixed(height, 1) +
         "\" preserveAspectRatio=\"none\" style=\"image-rendering:pixelated\" "
         "href=\"data:image/png;base64," +
         base64_of(png.data(), png.size()) + "\"/><polyline points=\"" + way +
         "\" fill=\"none\" stroke=\"#101820\" stroke-width=\"1.6\"/></svg>"
         "<div class=\"legend\">" +
         key(kBest, "1: alike in all directions") + key(kPoor, "near " + full_from) +
         key(kFaded, "the force fades") + key(kNoForce, "no force") + key(kOut, "out of reach") +
         "</div></section>\n";
}

}  // namespace firmtouch::host_sim
