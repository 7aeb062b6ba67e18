#pragma once
#include <string>
#include <string_view>

#include "curve/curve_points.hpp"

namespace firmtouch::tools {

/// Reads a curve: a header that names columns x, y and z (others are passed over), then a row of
/// numbers a sample, commas between, points in decimals, whatever the locale says. LF or CRLF.
/// Coordinates are read as double, multiplied by `unit_m` and rounded once to float.
CurvePoints read_curve_csv(const std::string& path, double unit_m);

/// The same from memory; `name` stands in the messages.
CurvePoints read_curve_csv_bytes(std::string_view text, const std::string& name, double unit_m);

}  // namespace firmtouch::tools
