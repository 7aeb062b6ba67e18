#include "curve/csv_rows.hpp"

#include <algorithm>

#include "surface/read/text_scan.hpp"

namespace firmtouch::tools {
namespace {

constexpr std::string_view kBlanks = " \t";
constexpr size_t kMaxDigits = 64;  // of a number with a decimal comma

std::string_view trimmed(std::string_view text) {
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == text.npos) return {};
  return text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
}

std::string_view unquoted(std::string_view field) {
  field = trimmed(field);
  if (field.size() >= 2 && (field.front() == '"' || field.front() == '\'') &&
      field.back() == field.front())
    field = trimmed(field.substr(1, field.size() - 2));
  return field;
}

}  // namespace

CsvRows::CsvRows(std::string_view text, bool has_decimal_commas)
    : rest_(text), has_decimal_commas_(has_decimal_commas) {
  const std::string_view begin = text.substr(0, 2);
  if (begin == "\xFF\xFE" || begin == "\xFE\xFF" || text.substr(0, 512).find('\0') != text.npos)
    problem_ = "is UTF-16 or no text: save it as UTF-8 (in a spreadsheet: CSV UTF-8)";
  if (text.substr(0, 3) == "\xEF\xBB\xBF") rest_.remove_prefix(3);
}

bool CsvRows::next_line() {
  if (rest_.empty()) return false;
  const size_t end = rest_.find_first_of("\r\n");
  row_ = trimmed(rest_.substr(0, end));
  const bool is_pair = end != rest_.npos && rest_.substr(end, 2) == "\r\n";
  rest_.remove_prefix(end == rest_.npos ? rest_.size() : end + (is_pair ? 2 : 1));
  ++line_;
  return true;
}

void CsvRows::choose_separator(std::string_view line) {
  separator_ = ' ';
  for (const char c : {'\t', ';', ','})
    if (line.find(c) != line.npos && !(c == ',' && has_decimal_commas_)) separator_ = c;
}

void CsvRows::split(std::string_view line, std::vector<std::string_view>& fields) const {
  fields.clear();
  for (size_t begin = 0;;) {
    size_t end = begin;
    char quote = 0;
    while (end < line.size()) {
      const char c = line[end];
      if (quote == 0 && (c == separator_ || (separator_ == ' ' && c == '\t'))) break;
      if (c == '"') quote = quote == 0 ? c : char{0};
      ++end;
    }
    fields.push_back(unquoted(line.substr(begin, end - begin)));
    if (end == line.size()) return;
    begin = end + 1;
    if (separator_ == ' ') begin = std::min(line.find_first_not_of(kBlanks, begin), line.size());
  }
}

bool CsvRows::next(std::vector<std::string_view>& fields) {
  while (problem_.empty() && next_line()) {
    if (row_.empty()) continue;
    if (row_[0] == '#' || row_[0] == '%') {
      if (separator_ != 0) continue;
      choose_separator(trimmed(row_.substr(1)));
      split(trimmed(row_.substr(1)), comment_);
      separator_ = 0;
      continue;
    }
    if (separator_ == 0 && row_.size() == 5 && row_.substr(0, 4) == "sep=") {
      separator_ = row_[4];
      continue;
    }
    if (separator_ == 0) choose_separator(row_);
    split(row_, fields);
    return true;
  }
  return false;
}

const char* CsvRows::number(std::string_view field, double& value) const {
  if (!has_decimal_commas_ || field.size() > kMaxDigits) return read_number(field, value);
  char digits[kMaxDigits];
  std::transform(field.begin(), field.end(), digits, [](char c) { return c == ',' ? '.' : c; });
  return read_number({digits, field.size()}, value);
}

std::string column_name(std::string_view field, double& unit_m) {
  static constexpr struct {
    std::string_view name;
    double unit_m;
  } kUnits[] = {{"m", 1}, {"cm", 0.01}, {"mm", 0.001}, {"in", 0.0254}, {"um", 1e-6}};
  unit_m = 0;
  const size_t end = field.find_first_of("([/_ ", 1);
  std::string_view unit =
      end == field.npos || field.empty() ? std::string_view{} : field.substr(end);
  while (!unit.empty() && std::string_view("([/_ ").find(unit.front()) != unit.npos)
    unit.remove_prefix(1);
  while (!unit.empty() && std::string_view(")] ").find(unit.back()) != unit.npos)
    unit.remove_suffix(1);
  for (const auto& known : kUnits)
    if (unit == known.name) unit_m = known.unit_m;
  std::string name(unit_m > 0 ? field.substr(0, end) : field);
  for (char& c : name) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return name;
}

}  // namespace firmtouch::tools
