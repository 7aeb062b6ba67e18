#pragma once
#include <cstdint>
#include <string_view>

namespace firmtouch::tools {

/// Words of a text file, line by line: LF, CRLF or CR ends a line, `#` starts a comment, a
/// backslash at the end of a line continues it. A byte order mark is passed over.
class TextScan {
 public:
  explicit TextScan(std::string_view text);

  bool next_line();  // to the line after this one; false at the end of the text
  bool next_word(std::string_view& word);  // of this line
  bool find_word(std::string_view& word);  // of this line or of a later one
  uint64_t line() const { return line_; }  // from 1
  const char* at() const { return at_; }

 private:
  bool ends_line() const { return at_ == end_ || *at_ == '\n' || *at_ == '\r' || *at_ == '#'; }
  void pass_line_end();

  const char* at_;
  const char* end_;
  uint64_t line_ = 0;
};

/// `word` as a number, whatever the locale says. Result: nullptr, or what is wrong with it (then
/// `value` is 0).
const char* read_number(std::string_view word, double& value);
const char* read_integer(std::string_view word, int64_t& value);

}  // namespace firmtouch::tools
