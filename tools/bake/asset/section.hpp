#pragma once
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "firmtouch/core/span.hpp"

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

}  // namespace firmtouch::tools
