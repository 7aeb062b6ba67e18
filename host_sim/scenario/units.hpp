#pragma once
#include <optional>
#include <string>

namespace firmtouch::host_sim {

/// `value` of `unit` in the SI unit of the same dimension as `wanted` ("mm" where "m" is wanted:
/// 0.001 value). Result: nothing where either unit is not known or the two measure different
/// things.
std::optional<double> to_si(double value, const std::string& unit, const std::string& wanted);

/// The units that may stand where `wanted` is wanted, for a message: "m, mm, um, cm, in".
std::string units_like(const std::string& wanted);

/// Reads a number; the whole of `text` must be one, and finite.
std::optional<double> read_number(const std::string& text);

}  // namespace firmtouch::host_sim
