#pragma once
#include <string>
#include <vector>

#include "cli/model_input.hpp"

namespace firmtouch::cli {

/// What the coordinates of all inputs of a bake count from (bake/asset/origin.hpp): by the box of
/// their models, but as in an asset that is among them. `is_fixed`: 0 unless such an asset has
/// another, as an object would turn about it.
/// Fails (bad input) where assets differ.
tools::Point asset_origin(const std::vector<std::string>& inputs, bool is_fixed,
                          const ModelOptions& options);

/// A sentence of the report.
std::string origin_text(tools::Point origin_m);

}  // namespace firmtouch::cli
