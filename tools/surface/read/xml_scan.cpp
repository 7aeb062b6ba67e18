#include "surface/read/xml_scan.hpp"

namespace firmtouch::tools {
namespace {

constexpr std::string_view kBlanks = " \t\r\n";

bool begins(std::string_view text, std::string_view with) {
  return text.substr(0, with.size()) == with;
}

// Where a tag ends: the first `>` outside the quotes of its attributes.
size_t end_of_tag(std::string_view text, size_t at) {
  while ((at = text.find_first_of("\"'>", at)) != text.npos && text[at] != '>') {
    at = text.find(text[at], at + 1);
    if (at++ == text.npos) return text.npos;
  }
  return at;
}

}  // namespace

bool XmlScan::next(Tag& tag) {
  for (;;) {
    at_ = text_.find('<', at_);
    if (at_ == text_.npos) return false;
    const std::string_view rest = text_.substr(at_);
    std::string_view end = ">";
    if (begins(rest, "<!--")) end = "-->";
    if (begins(rest, "<![CDATA[")) end = "]]>";
    if (begins(rest, "<?")) end = "?>";
    const size_t stop = end == ">" ? end_of_tag(text_, at_) : text_.find(end, at_);
    if (stop == text_.npos) return false;
    tag.byte = at_;
    std::string_view inside = text_.substr(at_ + 1, stop - at_ - 1);
    at_ = stop + end.size();
    if (inside.empty() || inside[0] == '!' || inside[0] == '?') continue;
    tag.closes = inside[0] == '/';
    if (tag.closes) inside.remove_prefix(1);
    tag.is_empty = !inside.empty() && inside.back() == '/';
    if (tag.is_empty) inside.remove_suffix(1);
    const size_t name = inside.find_first_of(kBlanks);
    tag.name = inside.substr(0, name);
    tag.attributes = name == inside.npos ? std::string_view{} : inside.substr(name);
    const size_t colon = tag.name.find(':');
    if (colon != tag.name.npos) tag.name.remove_prefix(colon + 1);
    return true;
  }
}

std::string_view attribute(const XmlScan::Tag& tag, std::string_view name) {
  std::string_view rest = tag.attributes;
  for (;;) {
    const size_t begin = rest.find_first_not_of(kBlanks);
    if (begin == rest.npos) return {};
    rest.remove_prefix(begin);
    const size_t equals = rest.find('=');
    if (equals == rest.npos) return {};
    const std::string_view key =
        rest.substr(0, rest.substr(0, equals).find_last_not_of(kBlanks) + 1);
    const size_t open = rest.find_first_of("\"'", equals);
    if (open == rest.npos) return {};
    const size_t close = rest.find(rest[open], open + 1);
    if (close == rest.npos) return {};
    if (key == name) return rest.substr(open + 1, close - open - 1);
    rest.remove_prefix(close + 1);
  }
}

}  // namespace firmtouch::tools
