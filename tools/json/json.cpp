#include "json/json.hpp"

#include <cmath>
#include <cstdio>

namespace firmtouch::tools {

std::string json_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    char escaped[8];
    if (letter == '"' || letter == '\\') {
      quoted += '\\';
      quoted += letter;
    } else if (static_cast<unsigned char>(letter) < 0x20 || letter == '<') {
      // `<` too: no text ends the script of a page that holds it.
      std::snprintf(escaped, sizeof(escaped), "\\u%04x", static_cast<unsigned>(letter));
      quoted += escaped;
    } else {
      quoted += letter;
    }
  }
  return quoted + "\"";
}

Json& Json::add(const std::string& name, const std::string& value) {
  text_ += (text_.empty() ? "" : ", ") + ("\"" + name + "\": " + value);
  return *this;
}

std::string json_number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return std::isfinite(value) ? text : "null";
}

}  // namespace firmtouch::tools
