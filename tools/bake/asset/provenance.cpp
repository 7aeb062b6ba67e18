#include "bake/asset/provenance.hpp"

#include <cstdio>
#include <string_view>

namespace firmtouch::tools {
namespace {

uint64_t fnv1a(const std::vector<uint8_t>& bytes) {
  uint64_t hash = 0xCBF29CE484222325ull;
  for (const uint8_t byte : bytes) hash = (hash ^ byte) * 0x100000001B3ull;
  return hash;
}

}  // namespace

Section text_section(uint32_t type, const std::string& name, const Facts& facts) {
  std::string text;
  for (const auto& fact : facts) text += fact.first + " " + fact.second + "\n";
  return make_section(type, name, text.data(), text.size());
}

Facts read_facts(const uint8_t* bytes, size_t count) {
  Facts facts;
  std::string_view rest(reinterpret_cast<const char*>(bytes), count);
  while (!rest.empty()) {
    const size_t end = rest.find('\n');
    const size_t blank = rest.substr(0, end).find(' ');
    if (end == rest.npos || blank == rest.npos) return {};
    facts.emplace_back(std::string(rest.substr(0, blank)),
                       std::string(rest.substr(blank + 1, end - blank - 1)));
    rest.remove_prefix(end + 1);
  }
  return facts;
}

Facts provenance(const std::string& file_name, const std::vector<uint8_t>& source,
                 const std::string& options, const std::string& tool) {
  char hash[17];
  std::snprintf(hash, sizeof(hash), "%016llx", static_cast<unsigned long long>(fnv1a(source)));
  return {{"source", file_name},
          {"source_bytes", std::to_string(source.size())},
          {"source_fnv1a64", hash},
          {"options", options.empty() ? "none" : options},
          {"tool", tool}};
}

std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof(text), "%.9g", value);
  return text;
}

}  // namespace firmtouch::tools
