#include "device/line_reader.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <sstream>
#include <utility>

#include "device/units.hpp"

namespace firmtouch::tools {
namespace {

constexpr double kMaxReach_m = 100;  // larger coordinates are a wrong unit, not a device

std::optional<double> finite_number(const std::string& text) {
  if (text.empty()) return {};
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  if (end != text.c_str() + text.size() || !std::isfinite(value)) return {};
  return value;
}

std::string short_number(double value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

// Levenshtein distance, for "did you mean".
size_t edits(const std::string& a, const std::string& b) {
  std::vector<size_t> row(b.size() + 1);
  for (size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (size_t i = 1; i <= a.size(); ++i) {
    size_t diagonal = row[0];
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t swap = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({swap, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

constexpr const char* kBlank = " \t\r";

bool is_blank(char c) { return std::string(kBlank).find(c) != std::string::npos; }

// Index after the quote that closes the one at `begin`; npos if none does.
size_t quote_end(const std::string& line, size_t begin) {
  for (size_t i = begin + 1; i < line.size(); ++i) {
    if (line[i] == '"') return i + 1;
    if (line[i] == '\\') ++i;
  }
  return std::string::npos;
}

// Index of the first # at the line's start or after a blank, outside quotes; npos: none.
size_t comment_begin(const std::string& line) {
  for (size_t i = 0; i < line.size(); ++i) {
    const bool begins_word = i == 0 || is_blank(line[i - 1]);
    if (begins_word && line[i] == '#') return i;
    if (begins_word && line[i] == '"') {
      const size_t end = quote_end(line, i);
      if (end == std::string::npos) return end;
      i = end - 1;
    }
  }
  return std::string::npos;
}

}  // namespace

std::string path_word(const std::string& path) {
  if (!path.empty() && path.find_first_of(" \t\r\n#\"\\") == std::string::npos) return path;
  std::string text = "\"";
  for (const char c : path)
    text += c == '\n' ? "\\n" : (c == '"' || c == '\\' ? "\\" : "") + std::string(1, c);
  return text + "\"";
}

void read_lines(const std::string& file, const std::string& text,
                const std::function<void(LineReader& words, int line)>& read,
                const std::vector<std::string>& names) {
  std::istringstream lines(text);
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    LineReader words(line, file + ":" + std::to_string(number), names, false);
    if (!words.empty()) read(words, number);
  }
}

LineReader::LineReader(const std::string& line, std::string place,
                       const std::vector<std::string>& names, bool overrides)
    : line_(line.substr(0, comment_begin(line))),
      place_(std::move(place)),
      names_(names),
      overrides_(overrides) {
  for (size_t i = line_.find_first_not_of(kBlank); i != std::string::npos;) {
    const size_t end = line_.find_first_of(kBlank, i);
    words_.push_back(line_.substr(i, end - i));
    offsets_.push_back(i);
    i = end == std::string::npos ? end : line_.find_first_not_of(kBlank, end);
  }
}

// Words of the file are in it: of any length, and whatever their bytes.
void LineReader::refuse(const std::string& what) const {
  constexpr size_t kMaxShown = 1000;
  std::string text = what.size() > kMaxShown ? what.substr(0, kMaxShown) + "..." : what;
  for (char& c : text)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7F') c = '?';
  throw Refused(place_ + ": " + text);
}

void LineReader::refuse_unknown(const std::string& kind, const std::string& name,
                                const std::string& help) const {
  std::string nearest, containing;
  size_t fewest = name.size() / 3 + 2;
  for (const std::string& known : names_) {
    const size_t count = edits(name, known);
    if (count < fewest) fewest = count, nearest = "`" + known + "`";
    // Names that contain the word: "stiffness" occurs in hand, contact and guide.
    if (name.size() > 3 && known.find(name) != std::string::npos)
      containing += (containing.empty() ? "`" : ", `") + known + "`";
  }
  if (nearest.empty()) nearest = containing;
  refuse("unknown " + kind + " `" + name + "`" +
         (nearest.empty() ? "; `" + help + "` lists the known ones"
                          : "; did you mean " + nearest + "?"));
}

std::string LineReader::next(const std::string& wanted) {
  if (!more()) refuse("the line ends where " + wanted + " is expected");
  return words_[at_++];
}

bool LineReader::take(const std::string& word) {
  if (!more() || words_[at_] != word) return false;
  ++at_;
  return true;
}

void LineReader::expect(const std::string& word) {
  const std::string found = next("`" + word + "`");
  if (found != word) refuse("`" + word + "` is expected instead of `" + found + "`");
}

std::string LineReader::path() {
  if (!more()) refuse("the line ends where a path is expected");
  const size_t begin = offsets_[at_];
  at_ = words_.size();
  const size_t end = line_.find_last_not_of(kBlank) + 1;
  if (line_[begin] != '"') return line_.substr(begin, end - begin);
  if (quote_end(line_, begin) != end)
    refuse("a quoted path must end with a quote at the line's end");
  std::string text;
  for (size_t i = begin + 1; i + 1 < end; ++i) {
    const bool escapes = line_[i] == '\\';
    if (escapes) ++i;
    text += escapes && line_[i] == 'n' ? '\n' : line_[i];
  }
  return text;
}

void LineReader::end() {
  if (more()) refuse("unexpected `" + words_[at_] + "` at the end of the statement");
}

double LineReader::number(const std::string& name) {
  const std::string text = next("the value of `" + name + "`");
  const std::optional<double> value = finite_number(text);
  if (!value) refuse("`" + name + "` needs a number instead of `" + text + "`");
  return *value;
}

double LineReader::in_si(const std::string& name, double value, const std::string& unit) {
  const std::string text = next("the unit of `" + name + "` (" + units_like(unit) + ")");
  const std::optional<double> si = to_si(value, text, unit);
  if (!si)
    refuse("`" + text + "` is not a unit for `" + name + "`; write one of: " + units_like(unit));
  return *si;
}

double LineReader::ranged(const std::string& name, double value, const std::string& unit,
                          double low, double high) const {
  const std::string in_unit = unit.empty() ? "" : " " + unit;
  if (!(value >= low && value <= high))
    refuse("`" + name + "` = " + short_number(value) + in_unit + " is outside " +
           short_number(low) + " to " + short_number(high) + in_unit);
  return value;
}

double LineReader::quantity(const std::string& name, const std::string& unit, double low,
                            double high) {
  const double value = number(name);
  return ranged(name, unit.empty() ? value : in_si(name, value, unit), unit, low, high);
}

Point LineReader::vector(const std::string& name, const std::string& unit, double most) {
  const double x = number(name), y = number(name), z = number(name);
  const double scale = unit.empty() ? 1 : in_si(name, 1, unit);
  const auto ranged_part = [&](double value) {
    return ranged(name, value * scale, unit, -most, most);
  };
  return {ranged_part(x), ranged_part(y), ranged_part(z)};
}

Point LineReader::point(const std::string& name) { return vector(name, "m", kMaxReach_m); }

}  // namespace firmtouch::tools
