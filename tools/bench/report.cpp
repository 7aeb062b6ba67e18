#include "bench/report.hpp"

#include <cmath>
#include <cstdio>
#include <limits>

namespace firmtouch::bench {

std::string number_text(double value) {
  if (!std::isfinite(value)) return std::isnan(value) ? "nan" : value > 0 ? "inf" : "-inf";
  char text[40];
  const double size = std::fabs(value);
  if (size >= 1e15 || (size > 0 && size < 1e-3)) {
    std::snprintf(text, sizeof(text), "%.3e", value);
  } else if (value <= std::floor(value) || size >= 1e5) {
    std::snprintf(text, sizeof(text), "%.0f", value);
  } else {
    std::snprintf(text, sizeof(text), "%.*f",
                  size >= 100  ? 1
                  : size >= 10 ? 2
                  : size >= 1  ? 3
                               : 4,
                  value);
  }
  return text;
}

bool Report::Figure::ok() const {
  if (goal_is == Goal::kAtMost) return value <= goal;
  if (goal_is == Goal::kAtLeast) return value >= goal;
  return true;
}

void Report::heading(const std::string& text) { entries_.push_back({text, {}, {}}); }

void Report::table(const std::vector<std::string>& heads,
                   const std::vector<std::vector<std::string>>& rows) {
  entries_.push_back({"", {heads, rows}, {}});
}

void Report::figure(const std::string& what, const std::string& model, double value,
                    const std::string& unit, const std::string& remark) {
  entries_.push_back({"", {}, {{what, model, value, unit, remark, Goal::kNone, 0, false}}});
}

void Report::bar(const std::string& what, const std::string& model, double value,
                 const std::string& unit, double goal, const std::string& remark) {
  entries_.push_back({"", {}, {{what, model, value, unit, remark, Goal::kAtMost, goal, false}}});
}

void Report::bar_at_least(const std::string& what, const std::string& model, double value,
                          const std::string& unit, double goal, const std::string& remark) {
  entries_.push_back({"", {}, {{what, model, value, unit, remark, Goal::kAtLeast, goal, false}}});
}

void Report::absent(const std::string& what, const std::string& model, const std::string& why) {
  const double none = std::numeric_limits<double>::quiet_NaN();
  entries_.push_back({"", {}, {{what, model, none, "", why, Goal::kNone, 0, true}}});
}

size_t Report::bars_not_met() const {
  size_t count = 0;
  for (const Entry& entry : entries_)
    for (const Figure& figure : entry.figure)
      if (!figure.ok()) ++count;
  return count;
}

}  // namespace firmtouch::bench
