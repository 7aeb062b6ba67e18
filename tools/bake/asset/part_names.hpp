#pragma once
#include <string>
#include <vector>

#include "firmtouch/asset/container.hpp"

namespace firmtouch::tools {

/// Names of the parts that an asset needs in a controller program, as in FIRMTOUCH_APP.
std::vector<std::string> needed_part_names(const asset::Container& asset);

/// The same as a list for FIRMTOUCH_APP: "mesh;guide".
std::string needed_parts_text(const asset::Container& asset);

/// A line for surfaces, one for guides and one for tools if there are several: which one a
/// controller uses, as it chooses (controller/first_of.hpp: meshes before splines, then the first),
/// and which ones not.
std::vector<std::string> used_of_several(const asset::Container& asset);

}  // namespace firmtouch::tools
