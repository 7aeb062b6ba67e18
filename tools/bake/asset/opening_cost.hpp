#pragma once
#include <string>

#include "firmtouch/asset/container.hpp"

namespace firmtouch::tools {

/// Instructions that opening an asset takes a Cortex-M7, about: what tools/bench/cortex-m7-opening
/// counted for assets of each kind, by the bytes of their sections. Of 50 assets, meshes, hulls and
/// paths were off by up to a fifth, splines and distance fields by up to a half, one of 10 patches
/// by four fifths.
double instructions_to_open(const asset::Container& asset);

/// The same for people.
std::string opening_cost_text(const asset::Container& asset);

}  // namespace firmtouch::tools
