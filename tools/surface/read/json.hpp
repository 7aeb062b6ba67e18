#pragma once
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace firmtouch::tools {

/// A JSON text as a flat list of values. Strings stand as in the text, escapes unread.
/// Bounds: at most 64 levels; time and memory in proportion to the text.
class JsonReader {
 public:
  enum class Kind : uint8_t { kNone, kObject, kArray, kString, kNumber, kWord };
  static constexpr uint32_t kNoValue = 0xFFFFFFFFu;

  /// Result: empty, or the problem with its byte.
  std::string parse(std::string_view text);

  uint32_t root() const { return values_.empty() ? kNoValue : 0; }
  Kind kind(uint32_t value) const;
  /// Of an object, the first of this name; kNoValue where there is none.
  uint32_t member(uint32_t object, std::string_view name) const;
  /// The items of an array, or of an object its values.
  std::vector<uint32_t> items(uint32_t value) const;
  std::string_view text(uint32_t value) const;
  /// A number; `otherwise` where the value is none.
  double number(uint32_t value, double otherwise) const;
  /// The same as a whole number from 0 to 2^53; -1 where it is anything else.
  int64_t whole(uint32_t value, int64_t otherwise) const;

 private:
  struct Value {
    Kind kind;
    std::string_view key, text;
    uint32_t first = kNoValue, next = kNoValue;
  };
  std::vector<Value> values_;
};

}  // namespace firmtouch::tools
