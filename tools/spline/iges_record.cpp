#include "spline/iges_record.hpp"

#include <algorithm>

#include "surface/read/text_scan.hpp"

namespace firmtouch::tools {
namespace {

constexpr char kMissing[] = "is missing: the entity's parameters end before it";
constexpr char kEmpty[] = "is missing: its field is empty, give it a value";
constexpr char kCut[] = "is cut short: the record has no end";

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// What may delimit fields: nothing that a number is written with.
bool may_delimit(char c) {
  return c > ' ' && c < 127 && !is_digit(c) && c != '+' && c != '-' && c != '.' && c != 'D' &&
         c != 'E' && c != 'H';
}

}  // namespace

uint64_t IgesRecord::line() const {
  if (lines_.empty()) return 0;
  return lines_[std::min(field_at_ / columns_, lines_.size() - 1)];
}

void IgesRecord::pass_blanks() {
  while (at_ < text_.size() && text_[at_] == ' ') ++at_;
}

bool IgesRecord::read_delimiters() {
  pass_blanks();
  const auto named = [this](char& into) {  // 1Hc, or nothing
    if (text_.compare(at_, 2, "1H") != 0) return true;
    if (at_ + 2 >= text_.size() || !may_delimit(text_[at_ + 2])) return false;
    into = text_[at_ + 2];
    at_ += 3;
    return true;
  };
  const auto passed = [this] {
    pass_blanks();
    if (at_ >= text_.size()) return false;
    ended_ = text_[at_] == delimiters_.record;
    return ended_ || text_[at_] == delimiters_.field;
  };
  if (!named(delimiters_.field) || !passed()) return false;
  if (ended_) return true;
  ++at_;
  pass_blanks();
  if (!named(delimiters_.record) || delimiters_.field == delimiters_.record || !passed())
    return false;
  ++at_;
  return true;
}

const char* IgesRecord::next_string() {
  size_t length = 0;
  for (size_t i = at_; text_[i] != 'H'; ++i) {
    length = length * 10 + static_cast<size_t>(text_[i] - '0');
    if (length > text_.size()) return kCut;
  }
  at_ = text_.find('H', at_) + 1;
  if (length > text_.size() - at_) return kCut;
  field_ = std::string_view(text_).substr(at_, length);
  is_string_ = true;
  at_ += length;
  pass_blanks();
  return nullptr;
}

const char* IgesRecord::next() {
  field_ = {};
  is_string_ = false;
  if (ended_) return nullptr;
  pass_blanks();
  field_at_ = at_;
  size_t digits = at_;
  while (digits < text_.size() && is_digit(text_[digits])) ++digits;
  if (digits > at_ && digits < text_.size() && text_[digits] == 'H') {
    if (const char* wrong = next_string()) return wrong;
  } else {
    const char both[] = {delimiters_.field, delimiters_.record, 0};
    const size_t end = std::min(text_.find_first_of(both, at_), text_.size());
    field_ = std::string_view(text_).substr(at_, end - at_);
    while (!field_.empty() && field_.back() == ' ') field_.remove_suffix(1);
    at_ = end;
  }
  if (at_ >= text_.size()) return kCut;
  if (text_[at_] != delimiters_.field && text_[at_] != delimiters_.record)
    return "is longer than it states";
  ended_ = text_[at_] == delimiters_.record;
  ++at_;
  return nullptr;
}

const char* IgesRecord::integer(int64_t& value) {
  if (const char* wrong = next()) return wrong;
  if (field_.empty() && !is_string_) return nullptr;
  if (is_string_) return "is a text where a whole number should stand";
  return read_integer(field_, value);
}

const char* IgesRecord::number(double& value) {
  if (const char* wrong = next()) return wrong;
  if (field_.empty() && !is_string_) return nullptr;
  if (is_string_) return "is a text where a number should stand";
  std::string word(field_);
  std::replace(word.begin(), word.end(), 'D', 'E');  // double precision, as Fortran writes it
  std::replace(word.begin(), word.end(), 'd', 'e');
  return read_number(word, value);
}

const char* IgesRecord::string(std::string& value) {
  if (const char* wrong = next()) return wrong;
  if (!field_.empty()) value = std::string(field_);
  return nullptr;
}

const char* IgesRecord::needed_integer(int64_t& value) {
  const bool was_ended = ended_;
  if (const char* wrong = integer(value)) return wrong;
  return !field_.empty() ? nullptr : was_ended ? kMissing : kEmpty;
}

const char* IgesRecord::needed_number(double& value) {
  const bool was_ended = ended_;
  if (const char* wrong = number(value)) return wrong;
  return !field_.empty() ? nullptr : was_ended ? kMissing : kEmpty;
}

const char* IgesRecord::finish() {
  const char* wrong = nullptr;
  while (!ended_ && wrong == nullptr) wrong = next();
  return wrong;
}

}  // namespace firmtouch::tools
