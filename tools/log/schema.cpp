#include "log/schema.hpp"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <sstream>

namespace firmtouch::log {
namespace {

constexpr const char* kTypeNames[] = {"u32", "i32", "f32"};

std::string number_text(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", number);
  return text;
}

// Line breaks and backslashes, so that one value is one line.
std::string escaped(const std::string& text) {
  std::string line;
  for (const char c : text) line += c == '\\' ? "\\\\" : c == '\n' ? "\\n" : std::string(1, c);
  return line;
}

std::string unescaped(const std::string& line) {
  std::string text;
  for (size_t i = 0; i < line.size(); ++i) {
    if (line[i] != '\\' || i + 1 == line.size())
      text += line[i];
    else
      text += line[++i] == 'n' ? '\n' : line[i];
  }
  return text;
}

bool read_count(const std::string& text, uint32_t least, uint32_t most, uint32_t& count) {
  if (text.empty() || text.size() > 10 || text.find_first_not_of("0123456789") != std::string::npos)
    return false;
  const unsigned long long found = std::strtoull(text.c_str(), nullptr, 10);
  if (found < least || found > most) return false;
  count = static_cast<uint32_t>(found);
  return true;
}

bool read_number(const std::string& text, double& number) {
  char* end = nullptr;
  number = std::strtod(text.c_str(), &end);
  return !text.empty() && *end == 0 && std::isfinite(number);
}

// field TYPE COUNT NAME UNIT SCALE ZERO
bool read_field(std::istringstream& words, Header& header) {
  std::string type, count, name, unit, scale, zero, rest;
  if (!(words >> type >> count >> name >> unit >> scale >> zero) || (words >> rest)) return false;
  name = printable(name);
  Field field;
  uint32_t kind = 0;
  while (kind < 3 && type != kTypeNames[kind]) ++kind;
  if (kind == 3 || !read_count(count, 1, 1024, field.count)) return false;
  if (!read_number(scale, field.scale) || !read_number(zero, field.zero)) return false;
  if (header.find(name) != nullptr) return false;
  field.type = static_cast<Type>(kind);
  field.name = name;
  field.unit = printable(unit);
  header.fields.push_back(field);
  return true;
}

// bit FIELD NUMBER WHAT...
bool read_bit(std::istringstream& words, Header& header) {
  std::string field, number;
  Bit bit;
  if (!(words >> field >> number) || !read_count(number, 0, 31, bit.bit)) return false;
  bit.field = printable(field);
  std::getline(words >> std::ws, bit.what);
  bit.what = printable(bit.what);
  header.bits.push_back(bit);
  return !bit.what.empty();
}

bool read_line(const std::string& line, Header& header) {
  const size_t blank = line.find(' ');
  if (blank == std::string::npos || blank == 0) return false;
  const std::string key = line.substr(0, blank);
  std::istringstream words(line.substr(blank + 1));
  if (key == "field") return read_field(words, header);
  if (key == "bit") return read_bit(words, header);
  if (key == "decimation")
    return read_count(line.substr(blank + 1), 1, UINT32_MAX, header.decimation);
  return header.text.emplace(key, unescaped(line.substr(blank + 1))).second;
}

}  // namespace

const Field* Header::find(const std::string& name) const {
  for (const Field& field : fields)
    if (field.name == name) return &field;
  return nullptr;
}

std::string Header::what(const std::string& field, uint32_t number) const {
  for (const Bit& bit : bits)
    if (bit.field == field && bit.bit == number) return bit.what;
  return "bit " + std::to_string(number);
}

std::string Header::names(const std::string& field, uint32_t set) const {
  std::string list;
  for (const Bit& bit : bits)
    if (bit.field == field && (set >> bit.bit & 1u) != 0)
      list += (list.empty() ? "" : "|") + bit.what;
  return list;
}

std::vector<Column> Header::columns() const {
  std::vector<Column> list;
  for (const Field& field : fields)
    for (uint32_t k = 0; k < field.count; ++k) {
      const std::string index = field.count > 1 ? "[" + std::to_string(k) + "]" : "";
      list.push_back({field.name + index, &field, field.offset + 4 * k});
    }
  return list;
}

std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == 0x7F) c = '?';
  return text;
}

std::string text_of(const Header& header) {
  std::string text;
  for (const Field& field : header.fields)
    text += std::string("field ") + kTypeNames[static_cast<int>(field.type)] + " " +
            std::to_string(field.count) + " " + field.name + " " + field.unit + " " +
            number_text(field.scale) + " " + number_text(field.zero) + "\n";
  for (const Bit& bit : header.bits)
    text += "bit " + bit.field + " " + std::to_string(bit.bit) + " " + bit.what + "\n";
  text += "decimation " + std::to_string(header.decimation) + "\n";
  for (const auto& [key, value] : header.text) text += key + " " + escaped(value) + "\n";
  return text;
}

std::string parse(const std::string& text, uint32_t record_bytes, Header& header) {
  std::istringstream lines(text);
  std::string line;
  for (size_t number = 1; std::getline(lines, line); ++number)
    if (!read_line(line, header))
      return "line " + std::to_string(number) +
             " of its text is not understood: " + printable(line).substr(0, 100);
  header.record_bytes = record_bytes;
  return "";
}

uint32_t place(std::vector<Field>& fields) {
  uint32_t at = 0;
  for (Field& field : fields) {
    field.offset = at;
    at += 4 * field.count;
  }
  return at;
}

double decimal_of(float number) {
  char text[32];
  for (int digits = 6; digits <= 9; ++digits) {
    std::snprintf(text, sizeof text, "%.*g", digits, static_cast<double>(number));
    const float again = std::strtof(text, nullptr);
    if (std::memcmp(&again, &number, sizeof number) == 0) break;
  }
  return std::strtod(text, nullptr);
}

uint32_t word(const uint8_t* record, uint32_t offset) {
  uint32_t found;
  std::memcpy(&found, record + offset, sizeof found);
  return found;
}

std::string stored_text(const Column& column, const uint8_t* record) {
  const uint32_t bits = word(record, column.offset);
  if (column.field->type == Type::kU32) return std::to_string(bits);
  if (column.field->type == Type::kI32) {
    int32_t found;
    std::memcpy(&found, &bits, sizeof found);
    return std::to_string(found);
  }
  float found;
  std::memcpy(&found, &bits, sizeof found);
  return number_text(static_cast<double>(found));
}

double value(const Field& field, uint32_t index, const uint8_t* record) {
  const uint32_t bits = word(record, field.offset + 4 * index);
  double stored = bits;
  if (field.type == Type::kI32) {
    int32_t found;
    std::memcpy(&found, &bits, sizeof found);
    stored = found;
  } else if (field.type == Type::kF32) {
    float found;
    std::memcpy(&found, &bits, sizeof found);
    stored = static_cast<double>(found);
  }
  return stored * field.scale + field.zero;
}

}  // namespace firmtouch::log
