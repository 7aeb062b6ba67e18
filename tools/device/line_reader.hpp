#pragma once
#include <functional>
#include <string>
#include <vector>

#include "device/refused.hpp"
#include "surface/point.hpp"

namespace firmtouch::tools {

/// Reads one line of a scenario or a device file from left to right. Every error throws Refused
/// with the place.
class LineReader {
 public:
  /// `names`: all keys and statements, for suggestions. `overrides`: a line from the command line,
  /// where a later value replaces an earlier one.
  LineReader(const std::string& line, std::string place, const std::vector<std::string>& names,
             bool overrides);

  bool empty() const { return words_.empty(); }
  bool overrides() const { return overrides_; }
  bool more() const { return at_ < words_.size(); }
  std::string next(const std::string& wanted);
  /// Consumes the next word if it equals `word`.
  bool take(const std::string& word);
  void expect(const std::string& word);
  /// The rest of the line as a path: unquoted, blanks included, or quoted by path_word().
  std::string path();
  /// A number and its unit, converted to SI. `unit` empty: dimensionless.
  double quantity(const std::string& name, const std::string& unit, double low, double high);
  /// Three numbers from -most to most, and one unit. `unit` empty: dimensionless.
  Point vector(const std::string& name, const std::string& unit, double most);
  /// A position in metres.
  Point point(const std::string& name);
  void end();

  [[noreturn]] void refuse(const std::string& what) const;
  /// `help`: the command that lists the known ones.
  [[noreturn]] void refuse_unknown(const std::string& kind, const std::string& name,
                                   const std::string& help = "firmtouch-sim run --help") const;

 private:
  double number(const std::string& name);
  double in_si(const std::string& name, double value, const std::string& unit);
  double ranged(const std::string& name, double value, const std::string& unit, double low,
                double high) const;

  std::string line_;
  std::string place_;
  const std::vector<std::string>& names_;
  bool overrides_;
  std::vector<std::string> words_;
  std::vector<size_t> offsets_;
  size_t at_ = 0;
};

/// Calls `read` with every line of a file that has words, and its number. `names` as of LineReader.
void read_lines(const std::string& file, const std::string& text,
                const std::function<void(LineReader& words, int line)>& read,
                const std::vector<std::string>& names = {});

/// A path as LineReader::path() reads it; quoted if it contains a blank, #, quote or backslash.
std::string path_word(const std::string& path);

}  // namespace firmtouch::tools
