#include "cli/plan_picture.hpp"

#include <algorithm>

#include "chart/chart.hpp"

namespace firmtouch::cli {
namespace {

using chart::fixed;

constexpr double kLeft = 330, kWidth = 560, kRow = 30, kTop = 34;

std::string box(double x, double y, double width, const char* colour) {
  return "<rect x=\"" + fixed(x, 1) + "\" y=\"" + fixed(y, 1) + "\" width=\"" + fixed(width, 1) +
         "\" height=\"18\" fill=\"" + colour + "\"/>\n";
}
std::string label(double x, double y, const std::string& text, const char* more = "") {
  return "<text x=\"" + fixed(x, 1) + "\" y=\"" + fixed(y, 1) + "\"" + more + ">" +
         chart::html_of(text) + "</text>\n";
}

// Flash, and the mean units of a query that touches and of one anywhere.
std::string facts_of(const PlanRow& row) {
  const std::string bytes = chart::grouped(row.flash()) + " B";
  if (!(row.work.random_mean > 0)) return bytes;
  return bytes + ", " + fixed(row.work.path_mean, 1) + " and " + fixed(row.work.random_mean, 1) +
         " units";
}

}  // namespace

std::string plan_picture(const Planner& planner, uint64_t flash) {
  const std::vector<PlanRow>& rows = planner.rows();
  uint64_t most = flash;
  for (const PlanRow& row : rows) most = std::max(most, row.flash());
  const auto wide = [&](uint64_t bytes) {
    return kWidth * static_cast<double>(bytes) / static_cast<double>(most);
  };
  const double height = kTop + kRow * static_cast<double>(rows.size()) + 10;
  std::string svg = "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1110 " +
                    fixed(height, 0) + "\" font-family=\"sans-serif\" font-size=\"12\">\n" +
                    "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n";
  const std::pair<const char*, const char*> kinds[] = {
      {"program", "#8a94a6"}, {"tree", "#2f6fde"}, {"field", "#1f9d6b"}, {"hull", "#d9822b"}};
  double x = kLeft;
  for (const auto& [name, colour] : kinds) {
    svg += box(x, 6, 12, colour) + label(x + 18, 20, name);
    x += 90;
  }
  std::string facts;  // over the line of the limit
  for (size_t i = 0; i < rows.size(); ++i) {
    const PlanRow& row = rows[i];
    const double y = kTop + kRow * static_cast<double>(i);
    const bool is_chosen = static_cast<int>(i) == planner.chosen();
    svg += label(10, y + 14, row.text(), is_chosen ? " font-weight=\"bold\"" : "");
    if (!row.refused.empty()) {
      svg += label(kLeft, y + 14, "cannot be baked");
      continue;
    }
    const uint64_t bytes[] = {row.image.flash, row.asset - row.field - row.hull, row.field,
                              row.hull};
    x = kLeft;
    for (size_t k = 0; k < 4; ++k) {
      svg += box(x, y, wide(bytes[k]), kinds[k].second);
      x += wide(bytes[k]);
    }
    facts += label(x + 6, y + 14, facts_of(row),
                   " stroke=\"#fff\" stroke-width=\"4\" paint-order=\"stroke\"");
  }
  const std::string end = fixed(kLeft + wide(flash), 1);
  svg += "<path d=\"M" + end + " " + fixed(kTop - 6, 0) + "V" + fixed(height - 4, 0) +
         "\" stroke=\"#c0392b\" stroke-width=\"2\"/>\n" +
         label(kLeft + 4 * 90, 20, "limit " + chart::grouped(flash) + " B", " fill=\"#c0392b\"") +
         label(kLeft + 500, 20, "units: mean of a query that touches, and of one anywhere");
  return svg + facts + "</svg>\n";
}

}  // namespace firmtouch::cli
