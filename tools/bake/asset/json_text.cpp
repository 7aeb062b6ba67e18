#include "bake/asset/json_text.hpp"

#include <cstdio>

namespace firmtouch::tools {

std::string json_text(const std::string& text) {
  std::string quoted = "\"";
  for (const char letter : text) {
    char escaped[8];
    if (letter == '"' || letter == '\\') {
      quoted += '\\';
      quoted += letter;
    } else if (static_cast<unsigned char>(letter) < 0x20) {
      std::snprintf(escaped, sizeof(escaped), "\\u%04x", static_cast<unsigned>(letter));
      quoted += escaped;
    } else {
      quoted += letter;
    }
  }
  return quoted + "\"";
}

}  // namespace firmtouch::tools
