#pragma once
#include <string>
#include <string_view>

#include "curve/curve_points.hpp"
#include "surface/file_frame.hpp"

namespace firmtouch::tools {

struct CsvOptions {
  bool has_decimal_commas = false;  // "1,5"; then semicolons, tabs or blanks separate fields
};

/// Reads a curve: columns x, y and z by the names of a header, in which they may have a unit
/// (others are passed over), or three columns without a header; then a row of numbers a sample,
/// written as CsvRows takes them, whatever the locale says.
/// Coordinates are read as double, placed by `frame` and rounded once to float.
CurvePoints read_curve_csv(const std::string& path, const FileFrame& frame,
                           const CsvOptions& options = {});

/// The same from memory; `name` stands in the messages.
CurvePoints read_curve_csv_bytes(std::string_view text, const std::string& name,
                                 const FileFrame& frame, const CsvOptions& options = {});

}  // namespace firmtouch::tools
