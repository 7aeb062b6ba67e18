#pragma once
#include <functional>
#include <string>
#include <vector>

#include "log/schema.hpp"

namespace firmtouch::log {

/// What a line shows of a record; `dt_s` since the one before, NaN where that is missing. NaN:
/// nothing.
using Value = std::function<double(const uint8_t* record, double dt_s)>;

struct Curve {
  std::string label;
  Value value;
  bool is_area = false;
};

/// A diagram of a plot.
struct Panel {
  std::string title, unit;
  std::vector<Curve> curves;
  bool is_logarithmic = false;
};

/// Force, position, distance, deviation, energy, steps, speed and period, as far as the log has
/// their fields.
std::vector<Panel> usual_panels(const Header& header);

/// One for each of these fields, by their names in the log (with or without an index); those of
/// bits are left to the lanes. Throws std::runtime_error where there is no such field.
std::vector<Panel> chosen_panels(const std::string& path, const Header& header,
                                 const std::vector<std::string>& names);

}  // namespace firmtouch::log
