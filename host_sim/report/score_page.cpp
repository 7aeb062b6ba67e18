#include "host_sim/report/score_page.hpp"

#include <algorithm>
#include <cstdio>
#include <functional>

#include "chart/chart.hpp"
#include "chart/envelope.hpp"
#include "host_sim/report/contact_quality.hpp"
#include "json/json.hpp"

namespace firmtouch::host_sim {
namespace {

constexpr double kDegrees = 57.29577951308232;
constexpr size_t kBins = 4096;  // of a chart
constexpr const char* kHead =
    "<!doctype html><html lang=\"en\"><head><meta charset=\"utf-8\"><style>"
    "body{margin:1.5rem auto;max-width:1160px;padding:0 1rem;background:#fff;color:#16202e;"
    "font-family:system-ui,Segoe UI,Roboto,Helvetica,Arial,sans-serif}"
    "td,th{padding:.15rem 1.2rem .15rem 0;text-align:left}.bad{color:#c02020;font-weight:600}"
    "</style>";

std::string short_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

std::string drawn(const std::string& title, const std::string& unit, size_t ticks, double seconds,
                  const std::function<double(size_t)>& value_at) {
  chart::Envelope values(std::min(ticks, kBins), ticks <= kBins);
  for (size_t i = 0; i < ticks; ++i) values.add(i * std::min(ticks, kBins) / ticks, value_at(i));
  chart::Chart chart;
  chart.title = title;
  chart.unit = unit;
  chart.series = {{title, "#1668c7", values.values()}};
  chart::TimeAxis axis;
  axis.seconds = seconds;
  return "<h3>" + title + ", " + unit + "</h3>" +
         chart::with_colours(chart::svg_of(chart, axis, chart::ChartSize{}, 0));
}

}  // namespace

std::vector<ScoreRow> rows_of(const Score& score, const ScoreSettings& settings) {
  const double ticks = static_cast<double>(std::max<size_t>(score.ticks, 1));
  return {
      {"buzz of 50 to 500 Hz, worst 2 s", score.buzz_N, "N",
       ContactQuality::kChatterShare * settings.force_limit_N},
      {"largest turn of contact in a tick", score.turn_rad * kDegrees, "degrees", kMaxTurn_deg},
      {"energy given to the hand", score.given_J * 1e3, "mJ", kMaxGiven_mJ},
      {"deepest without a proxy", score.deepest_radii, "tool radii", kMaxDepth_radii},
      {"ticks at the force limit", 100 * static_cast<double>(score.limit_ticks) / ticks, "%",
       kMaxLimit_percent},
      {"times that contact lets go", static_cast<double>(score.let_go), "", 0},
  };
}

std::string csv_of(const std::vector<ScoreRow>& rows) {
  std::string text = "figure,value,unit,bar,met\n";
  for (const ScoreRow& row : rows) {
    char numbers[80];
    std::snprintf(numbers, sizeof numbers, "\",%.9g,%s,%.9g,%d\n", row.value, row.unit.c_str(),
                  row.bar, row.is_met() ? 1 : 0);
    text += "\"" + row.figure + numbers;
  }
  return text;
}

std::string json_of(const std::vector<ScoreRow>& rows) {
  return tools::json_list(rows, [](const ScoreRow& row) {
    tools::Json object;
    object.add("figure", tools::json_text(row.figure)).add("value", row.value);
    object.add("unit", tools::json_text(row.unit)).add("bar", row.bar).add("met", row.is_met());
    return "\n  " + object.object();
  });
}

std::string score_page(const std::string& title, const std::vector<ScoreRow>& rows,
                       const std::vector<ScoredTick>& ticks, const ScoreSettings& settings) {
  std::string page = kHead + ("<title>" + chart::html_of(title) + "</title></head><body><h1>") +
                     chart::html_of(title) + "</h1><table><tr><th>figure<th>value<th>bar";
  for (const ScoreRow& row : rows)
    page += std::string("<tr") + (row.is_met() ? "" : " class=\"bad\"") + "><td>" + row.figure +
            "<td>" + short_text(row.value) + " " + row.unit + "<td>" + short_text(row.bar) +
            (row.is_met() ? "" : ": not met");
  page += "</table>";
  const size_t count = ticks.size();
  const double seconds = static_cast<double>(count) / settings.rate_Hz;
  page += drawn("Force", "N", count, seconds, [&](size_t i) { return norm(ticks[i].force_N); });
  page += drawn("Turn of contact in a tick", "degrees", count, seconds,
                [&](size_t i) { return i == 0 ? 0 : kDegrees * turn_rad(ticks[i - 1], ticks[i]); });
  double work_J = 0;
  page += drawn("Work of the force and energy stored", "mJ", count, seconds, [&](size_t i) {
    const ScoredTick& before = ticks[i > 0 ? i - 1 : 0];
    work_J += dot(before.force_N, ticks[i].device_m - before.device_m);
    return 1e3 * (work_J + stored_J(settings, before, ticks[i]));
  });
  page += drawn("Hand to proxy", "mm", count, seconds,
                [&](size_t i) { return ticks[i].depth_m * 1e3; });
  return page + "</body></html>\n";
}

}  // namespace firmtouch::host_sim
