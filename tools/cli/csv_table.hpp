#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace firmtouch::cli {

/// The columns given, row by row, as the nearest float32. With `more` rows come while they are
/// answered: it waits for one more, and returns false at the end.
struct CsvTable {
  std::vector<float> values;      // rows() * columns
  std::vector<uint32_t> line_of;  // of each row, from 1
  size_t columns = 0;
  std::function<bool(CsvTable&)> more;

  size_t rows() const { return line_of.size(); }
  bool has(size_t i) { return i < rows() || (more && more(*this)); }
  const float* row(size_t i) const { return &values[i * columns]; }
};

/// Reads `text` (of the file or stream `origin`): a header row that names at least `columns`, in
/// any order, then one row a line. Takes CRLF, blanks about values, empty lines and a byte-order
/// mark; other columns are ignored. `nan` and `inf` are values here. Fails (bad input) with the
/// line and the remedy on anything else, a row of more values than the header has names included.
/// `shift`: empty, or a value a column that is subtracted in double before the rounding.
CsvTable read_csv(const std::string& text, const std::string& origin,
                  const std::vector<std::string>& columns, const std::vector<double>& shift = {});

/// The same of standard input, line by line: before it waits for one, what was printed is sent.
CsvTable read_csv_lines(const std::vector<std::string>& columns, const std::vector<double>& shift);

}  // namespace firmtouch::cli
