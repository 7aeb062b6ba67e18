#include <cstdlib>
#include <string>

#include "firmtouch/params/table.hpp"
#include "host_sim/report/report.hpp"
#include "host_sim/report/run_charts.hpp"
#include "host_sim/report/scene3d.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kWidth = 1120;
constexpr uint32_t kImageWidth = 840, kImageHeight = 400;  // pixels; shown larger
constexpr double kImageTop = 64, kImageShown = 470;        // height
constexpr Colour kPaper{255, 255, 255};

std::string text_at(double x, double y, int size, const std::string& colour,
                    const std::string& text, int weight = 400) {
  return "<text x=\"" + fixed(x, 0) + "\" y=\"" + fixed(y, 0) + "\" font-size=\"" +
         std::to_string(size) + "\" font-weight=\"" + std::to_string(weight) + "\" fill=\"" +
         colour + "\">" + text + "</text>";
}

}  // namespace

std::string picture_of(const Report& report) {
  Scene3d scene3d = make_scene3d(report.environment, report.paths,
                                 parameter_value(report.scenario, params::kToolRadius));
  std::string key;
  double at = 24;
  for (Path& path : scene3d.paths) {
    if (path.key == "tool" || path.key == "hand") {
      path.points.clear();
      continue;
    }
    const std::string colour = path.values.empty() ? "rgb(" + std::to_string(path.colour.r) + "," +
                                                         std::to_string(path.colour.g) + "," +
                                                         std::to_string(path.colour.b) + ")"
                                                   : "rgb(226,60,40)";
    key += "<rect x=\"" + fixed(at, 0) + "\" y=\"522\" width=\"18\" height=\"4\" rx=\"2\" fill=\"" +
           colour + "\"/>" + text_at(at + 25, 528, 13, "#566175", html_of(path.label));
    at += 52 + 7.0 * static_cast<double>(path.label.size());
  }
  const std::string png =
      png_of(draw(scene3d, kImageWidth, kImageHeight, kPaper, report.paths.peak_device_m()));
  const Summary& s = report.summary;
  const double charts_top = kImageTop + kImageShown + 34;
  const chart::ChartSize size{kWidth - 48, 140};
  const size_t shown = std::min<size_t>(2, report.charts.charts().size());
  const double height = charts_top + static_cast<double>(shown) * 166 + 8;
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + fixed(kWidth, 0) +
                    " " + fixed(height, 0) +
                    "\" font-family=\"system-ui,Segoe UI,Roboto,Helvetica,Arial,sans-serif\"><rect "
                    "width=\"100%\" height=\"100%\" "
                    "rx=\"12\" fill=\"#ffffff\"/>";
  svg += text_at(24, 36, 19, "#16202e",
                 (scene3d.source_triangles > 0 ? grouped(scene3d.source_triangles) + " triangles"
                                               : "A guide") +
                     ", servo at " + fixed(s.rate_Hz, 0) + " Hz",
                 650);
  svg += text_at(24, 57, 13, "#566175",
                 "contact, peak force " + fixed(s.peak_force_N, 2) +
                     " N; worst tick: " + std::to_string(s.worst_visits) +
                     " visits; certificates checked on " + grouped(s.checked_ticks) + " ticks, " +
                     (s.wrong_bounds == 0 ? "all valid" : grouped(s.wrong_bounds) + " wrong"));
  const double shown_width = kImageShown * kImageWidth / kImageHeight;
  svg += "<image x=\"" + fixed((kWidth - shown_width) / 2, 0) + "\" y=\"" + fixed(kImageTop, 0) +
         "\" width=\"" + fixed(shown_width, 0) + "\" height=\"" + fixed(kImageShown, 0) +
         "\" href=\"data:image/png;base64," + base64_of(png.data(), png.size()) + "\"/>" + key;
  for (size_t i = 0; i < shown; ++i) {
    const double top = charts_top + static_cast<double>(i) * 166;
    svg += text_at(24, top + 14, 14, "#16202e", html_of(report.charts.charts()[i].title), 620);
    if (i == 0)
      svg += text_at(84, top + 14, 13, "#566175",
                     "bars: orange in contact, green on the guide; grey: motors off");
    svg += "<svg x=\"24\" y=\"" + fixed(top + 20, 0) + "\" width=\"" + fixed(size.width, 0) +
           "\" height=\"" + fixed(size.height, 0) + "\">" +
           svg_of(chart_of(report.charts.charts()[i]), report.charts.axis(), size, 0) + "</svg>";
  }
  return chart::with_colours(svg + "</svg>\n");
}

}  // namespace firmtouch::host_sim
