#include "host_sim/report/stage.hpp"

#include <limits>

#include "host_sim/report/page_data.hpp"
#include "host_sim/report/page_parts.hpp"

namespace firmtouch::host_sim {
namespace {

std::string legend(const Scene3d& scene3d) {
  std::string html = "<div class=\"legend\">";
  for (const Path& path : scene3d.paths)
    html += "<label><input type=\"checkbox\" checked data-path=\"" + path.key +
            "\"><i style=\"background:" +
            (path.values.empty() ? hex_of(path.colour)
                                 : "linear-gradient(90deg," + hex_of(heat(0.05)) + "," +
                                       hex_of(heat(0.4)) + "," + hex_of(heat(1)) + ")") +
            "\"></i>" + path.label + "</label>";
  return html +
         "<label class=\"upright\"><input type=\"checkbox\" id=\"upright\" autocomplete=\"off\">y "
         "is up</label></div>";
}

// Picture for browsers without JavaScript.
std::string noscript(const Scene3d& scene3d) {
  const std::string png = png_of(
      draw(scene3d, 720, 500, {238, 241, 245}, {std::numeric_limits<double>::quiet_NaN(), 0, 0}));
  return "<noscript><img alt=\"the part with its paths\" style=\"width:100%\" "
         "src=\"data:image/png;base64," +
         base64_of(png.data(), png.size()) + "\"></noscript>";
}

}  // namespace

std::string page_head(const std::string& title) {
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><meta name=\"viewport\" "
         "content=\"width=device-width,initial-scale=1\"><title>" +
         title + "</title><link rel=\"icon\" href=\"data:,\"><style>\n" + kReportCss +
         "</style></head>\n<body><main>";
}

std::string stage_of(const Scene3d& scene3d, const std::string& title, const std::string& more) {
  return "<section class=\"card stage\"><div class=\"title\"><h2>" + title +
         "</h2><span class=\"now\"></span></div>"
         "<div class=\"sight\"><p class=\"hint\">drag: rotate; Shift or two fingers: move; pinch, "
         "or "
         "click and scroll: zoom; double-click: reset</p><canvas id=\"stage\" tabindex=\"0\" "
         "role=\"img\" aria-label=\"the part in 3D with its paths\"></canvas></div>" +
         noscript(scene3d) + legend(scene3d) + more + "</section>";
}

}  // namespace firmtouch::host_sim
