#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace firmtouch::cli {

/// The columns given, row by row, as the nearest float32.
struct CsvTable {
  std::vector<float> values;      // rows() * columns
  std::vector<uint32_t> line_of;  // of each row, from 1
  size_t columns = 0;

  size_t rows() const { return line_of.size(); }
  const float* row(size_t i) const { return &values[i * columns]; }
};

/// Reads `text` (of the file or stream `origin`): a header row that names at least `columns`, in
/// any order, then one row a line. Takes CRLF, blanks about values, empty lines and a byte-order
/// mark; other columns are ignored. `nan` and `inf` are values here. Fails (bad input) with the
/// line and the remedy on anything else, a row of more values than the header has names included.
CsvTable read_csv(const std::string& text, const std::string& origin,
                  const std::vector<std::string>& columns);

}  // namespace firmtouch::cli
