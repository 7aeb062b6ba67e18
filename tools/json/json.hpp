#pragma once
#include <cstdint>
#include <string>

namespace firmtouch::tools {

/// `text` as a JSON string, quotes included; safe in the script of a page.
std::string json_text(const std::string& text);

/// %.9g; null if it is not finite.
std::string json_number(double value);

/// A JSON object, member by member.
class Json {
 public:
  /// `value` is JSON already.
  Json& add(const std::string& name, const std::string& value);
  Json& add(const std::string& name, double value) { return add(name, json_number(value)); }
  Json& add(const std::string& name, uint64_t value) { return add(name, std::to_string(value)); }
  Json& add(const std::string& name, bool value) {
    return add(name, std::string(value ? "true" : "false"));
  }
  std::string object() const { return "{" + text_ + "}"; }

 private:
  std::string text_;
};

/// A JSON list of what `of` makes of each item.
template <class List, class Of>
std::string json_list(const List& list, Of of) {
  std::string text;
  for (const auto& item : list) text += (text.empty() ? "" : ", ") + of(item);
  return "[" + text + "]";
}

}  // namespace firmtouch::tools
