#include <cstdio>

#include "log/statistics.hpp"

namespace firmtouch::log {
namespace {

constexpr size_t kShownGaps = 10;

std::string number(double value, const char* format = "%.6g") {
  char text[48];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string row(const std::string& what, const std::string& value) {
  std::string line = "  " + what;
  line.resize(line.size() < 16 ? 16 : line.size() + 1, ' ');
  return line + value + "\n";
}

std::string gap_text(const Gap& gap) {
  std::string text = std::to_string(gap.count) + " before record " + std::to_string(gap.number);
  if (gap.of_blocks > 0)
    text += " (" + std::to_string(gap.of_blocks) + " of them in blocks that are lost)";
  return text;
}

}  // namespace

std::string text_of(const Statistics& s) {
  std::string text = row("records", std::to_string(s.records) + " in " + std::to_string(s.blocks) +
                                        " blocks, " + number(s.seconds) + " s");
  if (s.records > 0)
    text += row("numbers", std::to_string(s.first_number) + " to " + std::to_string(s.last_number));
  text += row("missing", std::to_string(s.missing));
  for (size_t i = 0; i < s.gaps.size() && i < kShownGaps; ++i) text += row("", gap_text(s.gaps[i]));
  if (s.gaps.size() > kShownGaps)
    text += row("", "and in " + std::to_string(s.gaps.size() - kShownGaps) + " more places");
  if (!s.troubles.empty()) text += row("file", s.troubles);
  if (s.period.count > 0) {
    const Statistics::Period& p = s.period;
    text += row("period", "median " + number(p.median_us) + " us, mean " + number(p.mean_us) +
                              ", deviation " + number(p.deviation_us));
    text += row("", "least " + number(p.min_us) + ", 99 % " + number(p.p99_us) + ", 99.9 % " +
                        number(p.p999_us) + ", most " + number(p.max_us) + " at record " +
                        std::to_string(p.max_number));
  }
  if (!s.worst_steps.empty()) {
    std::string worst;
    for (const Statistics::Steps& at : s.worst_steps)
      worst += (worst.empty() ? "worst " : ", ") + std::to_string(at.steps) + " at record " +
               std::to_string(at.number);
    text += row("steps", "mean " + number(s.mean_steps) + "; " + worst);
  }
  if (s.max_force_N > 0)
    text += row("force", "most " + number(s.max_force_N, "%.3f") + " N at record " +
                             std::to_string(s.max_force_number));
  for (const Statistics::Fault& fault : s.faults)
    text += row("fault", fault.what + ": first at record " + std::to_string(fault.first_number) +
                             ", in " + std::to_string(fault.records) + " records");
  if (s.not_finite.records > 0)
    text += row("not finite", s.not_finite.first_field + ": first at record " +
                                  std::to_string(s.not_finite.first_number) + ", in " +
                                  std::to_string(s.not_finite.records) +
                                  " records some value is not finite");
  if (s.faults.empty()) text += row("faults", "none");
  return text;
}

}  // namespace firmtouch::log
