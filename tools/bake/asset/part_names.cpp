#include "bake/asset/part_names.hpp"

#include "firmtouch/controller/needed_parts.hpp"

namespace firmtouch::tools {

std::vector<std::string> needed_part_names(const asset::Container& asset) {
  const uint32_t parts = needed_parts(asset);
  std::vector<std::string> names;
  for (uint32_t number = 0; number < kPartCount; ++number)
    if ((parts >> number & 1u) != 0) names.emplace_back(part_name(number));
  return names;
}

std::string needed_parts_text(const asset::Container& asset) {
  std::string text;
  for (const std::string& name : needed_part_names(asset)) text += (text.empty() ? "" : ";") + name;
  return text.empty() ? "none" : text;
}

}  // namespace firmtouch::tools
