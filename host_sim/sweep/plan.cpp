#include "host_sim/sweep/plan.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace firmtouch::host_sim {
namespace {

std::string trimmed(const std::string& text) {
  const size_t first = text.find_first_not_of(' '), last = text.find_last_not_of(' ');
  return first == std::string::npos ? "" : text.substr(first, last - first + 1);
}

// "FIRST..LAST:COUNT UNIT"; no values if the text is something else.
std::vector<std::string> evenly(const std::string& text) {
  const size_t dots = text.find(".."), colon = text.find(':');
  std::vector<std::string> values;
  if (dots == std::string::npos || colon == std::string::npos || dots > colon) return values;
  const double first = std::strtod(text.substr(0, dots).c_str(), nullptr);
  const double last = std::strtod(text.substr(dots + 2, colon - dots - 2).c_str(), nullptr);
  char* unit = nullptr;
  const uint64_t count = std::strtoull(text.c_str() + colon + 1, &unit, 10);
  if (count < 2 || count > tools::kMaxRuns || !std::isfinite(last - first))
    throw Refused("--vary " + text + ": FIRST..LAST:COUNT needs two values or more, and numbers");
  for (uint64_t i = 0; i < count; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(count - 1);
    char number[32];
    std::snprintf(number, sizeof number, "%.9g", first + (last - first) * share);
    values.push_back(std::string(number) + unit);
  }
  return values;
}

}  // namespace

Varied varied_of(const std::string& text) {
  const size_t equals = text.find('=');
  Varied varied{trimmed(text.substr(0, equals)), {}};
  if (equals == std::string::npos || varied.key.empty())
    throw Refused("--vary " + text + ": write KEY=VALUE,VALUE,... or KEY=FIRST..LAST:COUNT UNIT");
  const std::string values = trimmed(text.substr(equals + 1));
  if (values.find('"') != std::string::npos)
    throw Refused("--vary " + text + ": a value has no quotes");
  varied.values = evenly(values);
  if (!varied.values.empty()) return varied;
  for (size_t begin = 0; begin <= values.size();) {
    const size_t end = std::min(values.find(',', begin), values.size());
    varied.values.push_back(trimmed(values.substr(begin, end - begin)));
    if (varied.values.back().empty()) throw Refused("--vary " + text + ": a value is empty");
    begin = end + 1;
  }
  return varied;
}

uint64_t combinations(const std::vector<Varied>& varied) {
  uint64_t count = 1;
  for (const Varied& one : varied) {
    count *= one.values.size();
    if (count > tools::kMaxRuns)
      throw Refused("a sweep of more than 10 million runs: vary less at once");
  }
  return count;
}

std::vector<std::string> values_of(const std::vector<Varied>& varied, uint64_t run) {
  std::vector<std::string> values(varied.size());
  for (size_t i = varied.size(); i-- > 0;) {
    values[i] = varied[i].values[run % varied[i].values.size()];
    run /= varied[i].values.size();
  }
  return values;
}

}  // namespace firmtouch::host_sim
