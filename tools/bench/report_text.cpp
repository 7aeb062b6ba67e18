#include <algorithm>

#include "bench/report.hpp"

namespace firmtouch::bench {
namespace {

using Row = std::vector<std::string>;

// Letters, not bytes: a name may hold any.
size_t width_of(const std::string& text) {
  size_t letters = 0;
  for (const char byte : text) letters += (static_cast<unsigned char>(byte) & 0xC0) == 0x80 ? 0 : 1;
  return letters;
}

bool is_number(const std::string& cell) {
  return !cell.empty() && cell.find_first_not_of("0123456789.,+-e %x") == std::string::npos;
}

// Columns as wide as their widest cell, numbers to the right.
std::string aligned(const std::vector<Row>& rows, size_t heads) {
  std::vector<size_t> widths;
  for (const Row& row : rows) {
    if (widths.size() < row.size()) widths.resize(row.size());
    for (size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width_of(row[c]));
  }
  std::vector<bool> right(widths.size(), true);
  for (size_t r = heads; r < rows.size(); ++r)
    for (size_t c = 0; c < rows[r].size(); ++c)
      if (!rows[r][c].empty() && !is_number(rows[r][c])) right[c] = false;
  std::string text;
  for (const Row& row : rows) {
    std::string line = " ";
    for (size_t c = 0; c < row.size(); ++c) {
      const std::string blanks(widths[c] - width_of(row[c]), ' ');
      line += ' ' + (right[c] ? blanks + row[c] : row[c] + blanks) + ' ';
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

Row row_of(const Report::Figure& f) {
  if (f.is_absent) return {f.what, f.model, "", "", "", f.remark};
  Row row{f.what, f.model, number_text(f.value), f.unit, "", f.remark};
  if (f.goal_is == Report::Goal::kNone) return row;
  row[4] = std::string(f.goal_is == Report::Goal::kAtMost ? "goal <= " : "goal >= ") +
           number_text(f.goal) + (f.ok() ? "  met" : "  NOT MET");
  return row;
}

}  // namespace

std::string to_text(const Report& report) {
  std::string text;
  std::vector<Row> figures;  // those that follow one another share their columns
  const auto flush = [&] {
    text += aligned(figures, 0);
    figures.clear();
  };
  for (const Report::Entry& entry : report.entries()) {
    for (const Report::Figure& figure : entry.figure) figures.push_back(row_of(figure));
    if (!entry.figure.empty()) continue;
    flush();
    if (!entry.heading.empty()) text += (text.empty() ? "" : "\n") + entry.heading + "\n";
    if (entry.table.heads.empty()) continue;
    std::vector<Row> rows{entry.table.heads};
    rows.insert(rows.end(), entry.table.rows.begin(), entry.table.rows.end());
    text += aligned(rows, 1);
  }
  flush();
  return text;
}

}  // namespace firmtouch::bench
