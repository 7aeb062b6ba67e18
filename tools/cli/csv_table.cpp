#include "cli/csv_table.hpp"

#include <charconv>
#include <cstdio>
#include <limits>
#include <string_view>

#include "cli/failure.hpp"
#include "curve/csv_rows.hpp"
#include "surface/read/load_file.hpp"

namespace firmtouch::cli {
namespace {

const std::string kStandardInput = "standard input";

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ",") + name;
  return text;
}

bool parse(std::string_view text, double& wide) {
  if (!text.empty() && text[0] == '+') text.remove_prefix(1);
  const auto result = std::from_chars(text.data(), text.data() + text.size(), wide);
  if (result.ptr != text.data() + text.size() || text.empty()) return false;
  if (result.ec == std::errc::result_out_of_range) {  // too large or too small for a double
    const bool tiny = text.find("e-") != text.npos || text.find("E-") != text.npos;
    wide = tiny ? 0 : std::numeric_limits<double>::infinity();
    if (text[0] == '-') wide = -wide;
  } else if (result.ec != std::errc()) {
    return false;
  }
  return true;
}

struct Reader {
  const std::string& origin;
  const std::vector<std::string>& columns;
  const std::vector<double>& shift;
  std::vector<size_t> places;  // of each column in a row
  std::vector<double> unit_m;  // of each, where its name has a unit
  size_t names_of_header = 0;
  CsvTable table;

  [[noreturn]] void fail(uint32_t line, const std::string& what) const {
    fail_input(origin + ":" + std::to_string(line) + ": " + what);
  }

  void read_header(const std::vector<std::string_view>& fields, uint32_t number) {
    std::vector<std::string> names;
    std::vector<double> units_m(fields.size());
    for (size_t i = 0; i < fields.size(); ++i)
      names.push_back(tools::column_name(fields[i], units_m[i]));
    names_of_header = names.size();
    for (const std::string& column : columns) {
      size_t found = names.size();
      for (size_t i = 0; i < names.size(); ++i) {
        if (names[i] != column) continue;
        if (found != names.size()) fail(number, "the header names column '" + column + "' twice");
        found = i;
      }
      if (found == names.size()) {
        fail(number, "the header has no column '" + column + "'; the first line must be " +
                         joined(columns));
      }
      places.push_back(found);
      unit_m.push_back(units_m[found] > 0 ? units_m[found] : 1);
    }
  }

  void read_row(const std::vector<std::string_view>& fields, uint32_t number) {
    if (fields.size() > names_of_header) {
      fail(number, "the row has " + std::to_string(fields.size()) + " values, the header " +
                       std::to_string(names_of_header) +
                       " columns; was a decimal comma used? Write numbers with a point, as 0.125");
    }
    for (size_t i = 0; i < columns.size(); ++i) {
      if (places[i] >= fields.size()) {
        fail(number, "the row has " + std::to_string(fields.size()) + " values, column '" +
                         columns[i] +
                         "' is missing; give every row a value for each column of the header");
      }
      double value = 0;
      if (!parse(fields[places[i]], value)) {
        fail(number, "column '" + columns[i] + "': '" +
                         std::string(fields[places[i]].substr(0, 40)) +
                         "' is not a number; write it with a point, as 0.125 or 1.25e-1");
      }
      table.values.push_back(shift.empty()
                                 ? static_cast<float>(value) * static_cast<float>(unit_m[i])
                                 : static_cast<float>(value * unit_m[i] - shift[i]));
    }
    table.line_of.push_back(number);
  }
};

// `skipped`: lines between the header and the rows, which `text` leaves out.
CsvTable read_rows(const std::string& text, const std::string& origin,
                   const std::vector<std::string>& columns, const std::vector<double>& shift,
                   uint32_t skipped) {
  Reader reader{origin, columns, shift, {}, {}, 0, {}};
  reader.table.columns = columns.size();
  tools::CsvRows rows(text, false);
  if (!rows.problem().empty()) fail_input(origin + ": " + rows.problem());
  std::vector<std::string_view> fields;
  while (rows.next(fields)) {
    const uint32_t number = static_cast<uint32_t>(rows.line());
    if (reader.places.empty()) {
      reader.read_header(fields, number);
    } else {
      reader.read_row(fields, number + skipped);
    }
  }
  if (reader.places.empty())
    fail_input(origin + ": is empty; the first line must be " + joined(columns));
  return reader.table;
}

// A line with its end; empty at the end of the input.
std::string next_line(uint32_t number) {
  std::string line;
  for (int letter = 0; (letter = std::getc(stdin)) != EOF;) {
    line += static_cast<char>(letter);
    if (letter == '\n') break;
    if (line.size() > tools::kMaxLineBytes)
      fail_input(kStandardInput + ":" + std::to_string(number) + ": the line is longer than " +
                 std::to_string(tools::kMaxLineBytes) + " bytes; break it");
  }
  return line;
}

// The header and what stands above it, then a row a line.
struct Lines {
  std::vector<std::string> columns;
  std::vector<double> shift;
  std::string head;
  uint32_t head_lines = 0, lines = 0;
  bool has_header = false;

  bool operator()(CsvTable& table) {
    for (;;) {
      std::fflush(stdout);
      const std::string line = next_line(++lines);
      if (!has_header) {
        head += line;
        head_lines = lines;
        tools::CsvRows rows(head, false);
        std::vector<std::string_view> fields;
        has_header = !rows.problem().empty() || rows.next(fields);
        if (has_header || line.empty()) (void)read_rows(head, kStandardInput, columns, shift, 0);
      } else if (!line.empty()) {
        const CsvTable one =
            read_rows(head + line, kStandardInput, columns, shift, lines - head_lines - 1);
        if (one.rows() == 0) continue;  // a comment or nothing
        table.values.insert(table.values.end(), one.values.begin(), one.values.end());
        table.line_of.push_back(lines);
        return true;
      }
      if (line.empty()) return false;
    }
  }
};

}  // namespace

CsvTable read_csv(const std::string& text, const std::string& origin,
                  const std::vector<std::string>& columns, const std::vector<double>& shift) {
  return read_rows(text, origin, columns, shift, 0);
}

CsvTable read_csv_lines(const std::vector<std::string>& columns, const std::vector<double>& shift) {
  CsvTable table;
  table.columns = columns.size();
  table.more = Lines{columns, shift, "", 0, 0, false};
  return table;
}

}  // namespace firmtouch::cli
