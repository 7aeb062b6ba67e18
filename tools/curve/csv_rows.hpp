#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace firmtouch::tools {

/// Rows of a table as spreadsheets, pandas and NumPy write it: commas, semicolons, tabs or blanks
/// between fields (the first row decides), fields in quotes, `#` or `%` before comments, a line
/// `sep=;`, LF, CRLF or CR.
/// Bounds: one pass; fields point into the text.
class CsvRows {
 public:
  /// `has_decimal_commas`: then no comma separates fields.
  CsvRows(std::string_view text, bool has_decimal_commas);

  /// UTF-16 or no text at all; else empty.
  const std::string& problem() const { return problem_; }
  /// The next row that is no comment. Result: false at the end.
  bool next(std::vector<std::string_view>& fields);
  /// The last comment before the first row, without its sign, as fields.
  const std::vector<std::string_view>& comment() const { return comment_; }
  uint64_t line() const { return line_; }
  std::string_view text() const { return row_; }
  /// A field as a number. Result: nullptr, or what is wrong with it.
  const char* number(std::string_view field, double& value) const;

 private:
  bool next_line();
  void split(std::string_view line, std::vector<std::string_view>& fields) const;
  void choose_separator(std::string_view line);

  std::string_view rest_, row_;
  bool has_decimal_commas_;
  char separator_ = 0;  // 0: not known yet; ' ': blanks
  uint64_t line_ = 0;
  std::string problem_;
  std::vector<std::string_view> comment_;
};

/// The name of a column in small letters, without its unit: "x" of `X`, `x (mm)`, `x [mm]`, `x/mm`,
/// `x_mm`. `unit_m`: metres of that unit, 0 where there is none.
std::string column_name(std::string_view field, double& unit_m);

}  // namespace firmtouch::tools
