// Draws what an example showed, when it ends: where the tool was, and the force on it, over time.
// Into the file that FIRMTOUCH_PICTURE names in the environment; without one nothing is drawn.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "chart/chart.hpp"
#include "examples/hand.hpp"

namespace firmtouch {
namespace {

constexpr size_t kPoints = 160;  // of a line
constexpr chart::ChartSize kSize{480, 130, 44, 10, 14, 22};
constexpr const char* kAxes[] = {"x", "y", "z"};
constexpr const char* kColours[] = {"var(--force)", "var(--good)", "var(--second)"};

class Picture {
 public:
  void add(const float (&tool_mm)[3], const float (&force_N)[3], float period_s) {
    for (size_t k = 0; k < 3; ++k) {
      tool_mm_[k].push_back(tool_mm[k]);
      force_N_[k].push_back(force_N[k]);
    }
    period_s_ = period_s;
  }
  ~Picture() {
    const char* path = std::getenv("FIRMTOUCH_PICTURE");
    if (path == nullptr) return;
    const std::string svg = chart::with_colours(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"480\" height=\"300\">\n<rect "
        "width=\"480\" height=\"300\" fill=\"#fff\"/>\n" +
        panel("tool", "mm", tool_mm_, 0) + panel("force on the tool", "N", force_N_, 150) +
        "</svg>\n");
    if (std::FILE* file = std::fopen(path, "wb")) {
      std::fwrite(svg.data(), 1, svg.size(), file);
      std::fclose(file);
    }
  }

 private:
  using Axes = std::vector<float>[3];

  // A chart of the axes on which something happens, under its title and their names.
  std::string panel(const char* title, const char* unit, const Axes& axes, int top) const {
    const size_t ticks = axes[0].size();
    const auto text = [&](int x, const char* colour, const std::string& what) {
      return "<text x=\"" + std::to_string(x) + "\" y=\"" + std::to_string(top + 14) +
             "\" font-family=\"sans-serif\" font-size=\"12\" fill=\"" + colour + "\">" + what +
             "</text>\n";
    };
    chart::Chart chart;
    chart.title = title;
    chart.unit = unit;
    std::string names = text(44, "var(--ink)", title);
    for (size_t k = 0; k < 3; ++k) {
      std::vector<double> values;
      float most = 0;
      for (size_t i = 0; i < kPoints && ticks > 0; ++i)
        values.push_back(static_cast<double>(axes[k][i * ticks / kPoints]));
      for (const float value : axes[k]) most = std::fmax(most, std::fabs(value));
      if (!(most > 0.01f)) continue;
      names += text(180 + 30 * static_cast<int>(k), kColours[k], kAxes[k]);
      chart.series.push_back({kAxes[k], kColours[k], values, false, 1.6});
    }
    chart::TimeAxis axis;
    axis.seconds = static_cast<double>(period_s_) * static_cast<double>(ticks);
    return names + "<svg y=\"" + std::to_string(top + 18) + "\" width=\"480\" height=\"130\">" +
           svg_of(chart, axis, kSize, 0) + "</svg>\n";
  }

  Axes tool_mm_, force_N_;
  float period_s_ = 0;
};

Picture picture;

}  // namespace

void show(math::Vec3 tool_m, math::Vec3 force_N, float period_s) {
  picture.add({tool_m.x * 1000, tool_m.y * 1000, tool_m.z * 1000},
              {force_N.x, force_N.y, force_N.z}, period_s);
}

}  // namespace firmtouch
