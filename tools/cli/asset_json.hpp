#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "bake/asset/provenance.hpp"
#include "firmtouch/asset/container.hpp"
#include "json/json.hpp"

namespace firmtouch::cli {

/// One asset of a file: its sections lie beside each other in the table.
struct NamedAsset {
  std::string name;
  std::vector<uint32_t> sections;
  tools::Facts facts;
  uint64_t bytes = 0;
};
std::vector<NamedAsset> assets_of(const asset::Container& container);

/// Fact of a linkage's bounds: what its own friction has at the tip, at least.
constexpr const char* kTipDamping = "least_damping_N_s_per_m";

const char* section_text(uint32_t type);

/// What `info --json` prints of a file, and `bake --json` of the one that it wrote.
tools::Json asset_json(const std::string& path, const asset::Container& container);

}  // namespace firmtouch::cli
