#pragma once
#include <string_view>

namespace firmtouch::tools {

/// The tags of an XML text one after another; text between them, comments and declarations are
/// passed over, and the prefix of a namespace is dropped.
/// Bounds: one pass, no memory.
class XmlScan {
 public:
  explicit XmlScan(std::string_view text) : text_(text) {}

  struct Tag {
    std::string_view name, attributes;
    bool closes = false;    // </name>
    bool is_empty = false;  // <name/>
    size_t byte = 0;        // where it begins
  };
  /// Result: false at the end, or where a tag has none.
  bool next(Tag& tag);

 private:
  std::string_view text_;
  size_t at_ = 0;
};

/// The value of an attribute as it stands; empty where there is none.
std::string_view attribute(const XmlScan::Tag& tag, std::string_view name);

}  // namespace firmtouch::tools
