#pragma once
#include <string>
#include <vector>

#include "cli/model_input.hpp"

namespace firmtouch::cli {

/// What the coordinates of all inputs of a bake count from (bake/asset/origin.hpp): by the box of
/// their models, but as in an asset that is among them. `has_turned_object`: then 0.
/// Fails (bad input) where assets differ, or one has an origin that must be 0.
tools::Point asset_origin(const std::vector<std::string>& inputs, bool has_turned_object,
                          const ModelOptions& options);

/// A sentence of the report.
std::string origin_text(tools::Point origin_m);

}  // namespace firmtouch::cli
