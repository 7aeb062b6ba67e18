#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "bake/asset/section.hpp"

namespace firmtouch::tools {

/// The bytes of an asset file, at an address fit for opening in place; or what is wrong and how to
/// mend it.
struct AssetFile {
  std::vector<uint8_t> bytes;
  std::string problem;  // empty: written
};

/// Packs sections into one asset file. The order of `sections` does not matter: the file's is
/// (name, type). The same sections give the same bytes on every machine.
AssetFile write_asset(std::vector<Section> sections);

/// Makes the CRCs of an altered file fit again, where its table still lies inside it: what an
/// attacker or a buggy writer would do. For tests of the rules behind the CRCs.
void repair_crcs(std::vector<uint8_t>& file);

/// What is wrong with `name` as an asset's name ("" where nothing is).
std::string name_problem(const std::string& name);

}  // namespace firmtouch::tools
