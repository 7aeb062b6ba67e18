#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "firmtouch/core/span.hpp"
#include "firmtouch/core/status.hpp"

namespace firmtouch::tools {

/// One section of an asset before it is written: its type, the asset's name, its bytes.
struct Section {
  uint32_t type;
  std::string name;
  std::vector<uint8_t> bytes;
};

template <class T>
Section make_section(uint32_t type, const std::string& name, const T* items, size_t count) {
  Section section{type, name, std::vector<uint8_t>(count * sizeof(T))};
  if (count != 0) std::memcpy(section.bytes.data(), items, section.bytes.size());
  return section;
}

template <class T>
Section make_section(uint32_t type, const std::string& name, const std::vector<T>& items) {
  return make_section(type, name, items.data(), items.size());
}

/// The bytes of the section of this name and type; empty where there is none.
inline core::Bytes find_section(const std::vector<Section>& sections, const std::string& name,
                                uint32_t type) {
  for (const Section& s : sections)
    if (s.type == type && s.name == name)
      return core::Bytes(s.bytes.data(), static_cast<uint32_t>(s.bytes.size()));
  return core::Bytes();
}

/// The sections of geometry `name` as its open() takes them: mesh::Sections and the like.
template <class Sections>
Sections sections_of(const std::vector<Section>& baked, const std::string& name) {
  Sections sections;
  sections.each(
      [&](uint32_t type, core::Bytes& bytes) { bytes = find_section(baked, name, type); });
  return sections;
}

/// Proves a baked geometry. The view reads `baked`, which must stay alive.
template <class View>
core::Verdict open_baked(const std::vector<Section>& baked, const std::string& name, View& view) {
  return open(sections_of<typename View::Sections>(baked, name), view);
}

}  // namespace firmtouch::tools
