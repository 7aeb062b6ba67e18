#pragma once
#include <optional>
#include <string>

namespace firmtouch::tools {

/// Converts `value` from `unit` to SI: 1 "mm" for "m" gives 0.001.
/// Result: nullopt if a unit is unknown or `unit` and `wanted` have different dimensions.
std::optional<double> to_si(double value, const std::string& unit, const std::string& wanted);

/// The accepted units of the same dimension, for a message: "m, mm, um, cm, in".
std::string units_like(const std::string& wanted);

}  // namespace firmtouch::tools
