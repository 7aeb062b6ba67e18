#include "surface/read/json.hpp"

#include "surface/read/text_scan.hpp"

namespace firmtouch::tools {
namespace {

constexpr size_t kMaxLevels = 64;
constexpr std::string_view kBlanks = " \t\r\n";

}  // namespace

std::string JsonReader::parse(std::string_view text) {
  values_.clear();
  struct Level {
    uint32_t value, last;
  };
  std::vector<Level> open;
  size_t at = 0;
  std::string_view key;
  const auto problem = [&](const char* what) {
    return "byte " + std::to_string(at) + ": " + what + ": the JSON is damaged; export it again";
  };
  const auto skip = [&] { at = std::min(text.find_first_not_of(kBlanks, at), text.size()); };
  const auto read_string = [&](std::string_view& out) {
    const size_t begin = ++at;
    while (at < text.size() && text[at] != '"') at += text[at] == '\\' ? size_t{2} : size_t{1};
    if (at >= text.size()) return false;
    out = text.substr(begin, at++ - begin);
    return true;
  };
  for (bool wants_value = true;;) {
    skip();
    if (at == text.size())
      return open.empty() && !values_.empty() ? std::string() : problem("the text ends here");
    const char c = text[at];
    if (!open.empty() && (c == '}' || c == ']')) {
      const bool is_object = values_[open.back().value].kind == Kind::kObject;
      if (is_object != (c == '}') || (wants_value && open.back().last != kNoValue))
        return problem("a bracket that does not fit");
      open.pop_back();
      wants_value = false;
      ++at;
      continue;
    }
    if (!wants_value) {
      if (open.empty()) return problem("something follows the end");
      if (c != ',') return problem("a comma is missing");
      wants_value = true;
      ++at;
      continue;
    }
    key = {};
    if (!open.empty() && values_[open.back().value].kind == Kind::kObject) {
      if (c != '"' || !read_string(key)) return problem("a name is missing");
      skip();
      if (at == text.size() || text[at] != ':') return problem("a colon is missing");
      ++at;
      skip();
      if (at == text.size()) return problem("the text ends here");
    }
    Value value{Kind::kWord, key, {}};
    const uint32_t number = static_cast<uint32_t>(values_.size());
    if (text[at] == '{' || text[at] == '[') {
      value.kind = text[at++] == '{' ? Kind::kObject : Kind::kArray;
    } else if (text[at] == '"') {
      value.kind = Kind::kString;
      if (!read_string(value.text)) return problem("a string has no end");
    } else {
      const size_t end = std::min(text.find_first_of(",]} \t\r\n", at), text.size());
      value.text = text.substr(at, end - at);
      double parsed = 0;
      if (read_number(value.text, parsed) == nullptr) value.kind = Kind::kNumber;
      const bool is_word = value.text == "true" || value.text == "false" || value.text == "null";
      if (value.kind == Kind::kWord && !is_word) return problem("a value that is none");
      at = end;
    }
    if (!open.empty()) {
      uint32_t& last = open.back().last;
      (last == kNoValue ? values_[open.back().value].first : values_[last].next) = number;
      last = number;
    }
    values_.push_back(value);
    wants_value = value.kind == Kind::kObject || value.kind == Kind::kArray;
    if (!wants_value) continue;
    if (open.size() == kMaxLevels) return problem("more than 64 levels");
    open.push_back({number, kNoValue});
  }
}

JsonReader::Kind JsonReader::kind(uint32_t value) const {
  return value < values_.size() ? values_[value].kind : Kind::kNone;
}

uint32_t JsonReader::member(uint32_t object, std::string_view name) const {
  if (kind(object) != Kind::kObject) return kNoValue;
  for (uint32_t v = values_[object].first; v != kNoValue; v = values_[v].next)
    if (values_[v].key == name) return v;
  return kNoValue;
}

std::vector<uint32_t> JsonReader::items(uint32_t value) const {
  std::vector<uint32_t> found;
  if (value >= values_.size()) return found;
  for (uint32_t v = values_[value].first; v != kNoValue; v = values_[v].next) found.push_back(v);
  return found;
}

std::string_view JsonReader::text(uint32_t value) const {
  return value < values_.size() ? values_[value].text : std::string_view{};
}

double JsonReader::number(uint32_t value, double otherwise) const {
  double read = otherwise;
  if (kind(value) == Kind::kNumber) read_number(values_[value].text, read);
  return read;
}

int64_t JsonReader::whole(uint32_t value, int64_t otherwise) const {
  if (kind(value) == Kind::kNone) return otherwise;
  const double read = number(value, -1);
  const int64_t whole = read >= 0 && read <= 0x1p53 ? static_cast<int64_t>(read) : -1;
  return static_cast<double>(whole) < read || static_cast<double>(whole) > read ? -1 : whole;
}

}  // namespace firmtouch::tools
