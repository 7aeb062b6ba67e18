#include "cli/cpp_source.hpp"

#include <cstdio>

namespace firmtouch::cli {

std::string cpp_source(const std::vector<uint8_t>& asset, const std::string& symbol) {
  const std::string size = std::to_string(asset.size());
  std::string text =
      "// Made by firmtouch bake --cpp. Declare it where it is used:\n"
      "//     extern const unsigned char " +
      symbol +
      "[];\n"
      "//     extern const unsigned " +
      symbol +
      "_size;\n"
      "extern constexpr unsigned " +
      symbol + "_size = " + size +
      ";\n"
      "alignas(16) extern constexpr unsigned char " +
      symbol + "[" + size + "] = {";
  for (size_t i = 0; i < asset.size(); ++i) {
    char item[8];
    std::snprintf(item, sizeof(item), "%s%u,", i % 20 == 0 ? "\n" : "",
                  static_cast<unsigned>(asset[i]));
    text += item;
  }
  return text + "\n};\n";
}

std::string symbol_of(const std::string& file_name) {
  std::string symbol;
  for (const char letter : file_name) {
    const bool plain = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                       (letter >= '0' && letter <= '9');
    symbol += plain ? letter : '_';
  }
  if (symbol.empty() || (symbol[0] >= '0' && symbol[0] <= '9')) symbol = "asset_" + symbol;
  return symbol;
}

}  // namespace firmtouch::cli
