#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "bake/asset/section.hpp"

namespace firmtouch::tools {

/// Lines of `key value`: what an asset's text sections hold.
using Facts = std::vector<std::pair<std::string, std::string>>;

Section text_section(uint32_t type, const std::string& name, const Facts& facts);
/// Result: empty where the bytes are not such lines (another program's section).
Facts read_facts(const uint8_t* bytes, size_t count);

/// Where an asset comes from: the source's file name (without folders: the same bytes on every
/// machine), its length and FNV-1a hash, the options that shaped the bake, the tool and its
/// version.
Facts provenance(const std::string& file_name, const std::vector<uint8_t>& source,
                 const std::string& options, const std::string& tool);

/// "%.9g", which brings every float32 back.
std::string number_text(double value);

}  // namespace firmtouch::tools
