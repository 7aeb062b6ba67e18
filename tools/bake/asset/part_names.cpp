#include "bake/asset/part_names.hpp"

#include "firmtouch/controller/needed_parts.hpp"
#include "firmtouch/device/compensation.hpp"
#include "firmtouch/device/derating.hpp"
#include "firmtouch/device/index_pulses.hpp"
#include "firmtouch/device/second_encoders.hpp"

namespace firmtouch::tools {

std::vector<std::string> needed_part_names(const asset::Container& asset) {
  const uint32_t parts = needed_parts(asset);
  std::vector<std::string> names;
  for (uint32_t number = 0; number < kPartCount; ++number)
    if ((parts >> number & 1u) != 0) names.emplace_back(part_name(number));
  for (uint32_t i = 0; i < asset.section_count(); ++i) {
    if (asset.type(i) != device::kLinkageSection) continue;
    const core::Bytes whole = asset.section(i), unsprung = device::Compensation::before(whole);
    const core::Bytes cold = device::Derating::before(unsprung);
    const core::Bytes homed = device::IndexPulses::before(cold);
    const core::Bytes first = device::SecondEncoders::before(homed);
    if (first.size() == sizeof(device::HomedLinkageLayout)) names.emplace_back("homing");
    if (homed.size() < cold.size()) names.emplace_back("index_pulses");
    if (first.size() < homed.size()) names.emplace_back("second_encoders");
    if (cold.size() < unsprung.size()) names.emplace_back("derating");
    if (unsprung.size() < whole.size()) names.emplace_back("compensation");
  }
  return names;
}

std::string needed_parts_text(const asset::Container& asset) {
  std::string text;
  for (const std::string& name : needed_part_names(asset)) text += (text.empty() ? "" : ";") + name;
  return text.empty() ? "none" : text;
}

std::vector<std::string> used_of_several(const asset::Container& asset) {
  struct Kind {
    const char *name, *remedy;
    uint32_t parts[2];
  };
  constexpr Kind kKinds[] = {
      {"surface", "a scenario may choose: mesh NAME", {kPartMesh, kPartSpline}},
      {"guide", "a scenario may choose: guide NAME", {kPartGuide, kPartSplineGuide}},
      {"tool", "bake one alone", {kPartTool, 0}}};
  std::vector<std::string> lines;
  const bool has_objects = (needed_parts(asset) & kPartObjects) != 0;
  for (const Kind& kind : kKinds) {
    if (has_objects && kind.parts[0] == kPartMesh) continue;  // they are all touched
    std::vector<std::string> names;
    for (const uint32_t part : kind.parts)
      for (uint32_t i = 0; i < asset.section_count(); ++i)
        if ((part_of_section(asset, i) & part) != 0)
          names.push_back("`" + std::string(asset.name(i)) + "`");
    if (names.size() < 2) continue;
    std::string line = std::string("a controller uses ") + kind.name + " " + names[0] + ", not ";
    for (size_t i = 1; i < names.size(); ++i) line += (i == 1 ? "" : ", ") + names[i];
    lines.push_back(line + "; " + kind.remedy);
  }
  return lines;
}

}  // namespace firmtouch::tools
