#pragma once
#include <string>
#include <vector>

namespace firmtouch::log {

/// Charts of a log over its time: force, position, speed, distance with its certified bound,
/// deviation from the guide, energy, steps, period; of these, those whose fields it has. With
/// `fields` ("output.force_N[2]", "output.steps"): these instead. Missing records interrupt the
/// lines and are marked, faults too. Throws std::runtime_error for an unknown field or a log without
/// records.
/// Result: one SVG; with `as_page` an HTML page around it, with what statistics_of() tells.
std::string plot(const std::string& path, const std::vector<std::string>& fields, bool as_page);

}  // namespace firmtouch::log
