#include "surface/read/text_scan.hpp"

#include <charconv>

namespace firmtouch::tools {

TextScan::TextScan(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {
  if (text.size() >= 3 && text.substr(0, 3) == "\xEF\xBB\xBF") at_ += 3;
}

void TextScan::pass_line_end() {
  if (at_ == end_) return;
  const char first = *at_++;
  if (first == '\r' && at_ != end_ && *at_ == '\n') ++at_;
}

bool TextScan::next_line() {
  if (line_ != 0) {
    while (at_ != end_ && *at_ != '\n' && *at_ != '\r') ++at_;
    pass_line_end();
  }
  if (at_ == end_) return false;
  ++line_;
  return true;
}

bool TextScan::next_word(std::string_view& word) {
  while (at_ != end_) {
    if (*at_ == ' ' || *at_ == '\t' || *at_ == '\v' || *at_ == '\f') {
      ++at_;
    } else if (*at_ == '\\' && end_ - at_ > 1 && (at_[1] == '\n' || at_[1] == '\r')) {
      ++at_;
      pass_line_end();
      ++line_;
    } else {
      break;
    }
  }
  if (ends_line()) return false;
  const char* first = at_;
  while (at_ != end_ && *at_ != ' ' && *at_ != '\t' && *at_ != '\n' && *at_ != '\r') ++at_;
  word = std::string_view(first, static_cast<size_t>(at_ - first));
  return true;
}

bool TextScan::find_word(std::string_view& word) {
  if (line_ == 0 && !next_line()) return false;
  while (!next_word(word)) {
    if (!next_line()) return false;
  }
  return true;
}

const char* read_number(std::string_view word, double& value) {
  value = 0;
  if (!word.empty() && word[0] == '+') word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const std::from_chars_result result = std::from_chars(word.data(), end, value);
  if (result.ec == std::errc::result_out_of_range && result.ptr == end) {
    if (word.find("e-") != word.npos || word.find("E-") != word.npos)
      return nullptr;  // rounds to 0
    return "is too large for a number";
  }
  if (result.ec == std::errc() && result.ptr == end) {
    if (value - value <= 0) return nullptr;
    value = 0;
    return "is not finite";
  }
  value = 0;
  if (word.find(',') != word.npos) return "has a comma: write decimals with a point";
  return "is not a number";
}

const char* read_integer(std::string_view word, int64_t& value) {
  value = 0;
  if (!word.empty() && word[0] == '+') word.remove_prefix(1);
  const char* end = word.data() + word.size();
  const std::from_chars_result result = std::from_chars(word.data(), end, value);
  if (result.ec == std::errc::result_out_of_range) return "is too large for an index";
  if (result.ec == std::errc() && result.ptr == end) return nullptr;
  value = 0;
  return "is not a whole number";
}

}  // namespace firmtouch::tools
