#pragma once
#include <string>

#include "firmtouch/asset/container.hpp"

namespace firmtouch::tools {

/// Instructions that opening an asset takes a Cortex-M7, about: what tools/bench/cortex-m7-opening
/// counted for assets of each kind, by the bytes of their sections. Meshes, hulls and paths are off
/// by less than a fifth, splines by up to a half, and tiny assets by their probe queries.
double instructions_to_open(const asset::Container& asset);

/// The same for people.
std::string opening_cost_text(const asset::Container& asset);

}  // namespace firmtouch::tools
