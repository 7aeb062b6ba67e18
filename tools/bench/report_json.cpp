#include <cmath>
#include <cstdio>

#include "bench/report.hpp"
#include "json/json.hpp"

namespace firmtouch::bench {
namespace {

std::string json_number(double value) {
  if (!std::isfinite(value)) return "null";
  char text[40];
  std::snprintf(text, sizeof(text), "%.9g", value);
  return text;
}

std::string json_list(const std::vector<std::string>& cells) {
  std::string text = "[";
  for (const std::string& cell : cells)
    text += (text.size() > 1 ? ", " : "") + tools::json_text(cell);
  return text + "]";
}

std::string json_figure(const Report::Figure& f, const std::string& heading) {
  std::string text =
      "{\"heading\": " + tools::json_text(heading) + ", \"what\": " + tools::json_text(f.what) +
      ", \"model\": " + tools::json_text(f.model) + ", \"value\": " + json_number(f.value) +
      ", \"unit\": " + tools::json_text(f.unit);
  if (f.goal_is != Report::Goal::kNone) {
    const bool at_most = f.goal_is == Report::Goal::kAtMost;
    text += ", \"goal\": " + json_number(f.goal) +
            ", \"goal_is\": " + tools::json_text(at_most ? "at most" : "at least") +
            ", \"ok\": " + (f.ok() ? "true" : "false");
  }
  return text + ", \"remark\": " + tools::json_text(f.remark) + "}";
}

}  // namespace

std::string to_json_members(const Report& report) {
  std::string figures, tables, heading;
  for (const Report::Entry& entry : report.entries()) {
    if (!entry.heading.empty()) heading = entry.heading;
    for (const Report::Figure& f : entry.figure)
      figures += (figures.empty() ? "\n    " : ",\n    ") + json_figure(f, heading);
    if (entry.table.heads.empty()) continue;
    tables += (tables.empty() ? "\n    " : ",\n    ") +
              ("{\"heading\": " + tools::json_text(heading)) +
              ", \"heads\": " + json_list(entry.table.heads) + ", \"rows\": [";
    for (size_t r = 0; r < entry.table.rows.size(); ++r)
      tables += (r == 0 ? "" : ", ") + json_list(entry.table.rows[r]);
    tables += "]}";
  }
  return "\"figures\": [" + figures + "], \"tables\": [" + tables + "]";
}

}  // namespace firmtouch::bench
