#pragma once
#include <string>
#include <vector>

namespace firmtouch::log {

/// Charts of a log over its time: force, position, speed, distance with its certified bound,
/// deviation from the guide, energy, steps, period; of these, those whose fields it has. With
/// `fields` ("output.force_N[2]", "output.state"): these instead. Missing records interrupt the
/// lines and are marked; above them stand, in words, the bits that are set: faults, state, lines.
/// Throws std::runtime_error for an unknown field or a log without records.
/// Result: one SVG; with `as_page` an HTML page around it, with the text of statistics_of().
/// `troubles`: defects of the log, if not null; its whole blocks are drawn.
std::string plot(const std::string& path, const std::vector<std::string>& fields, bool as_page,
                 std::string* troubles = nullptr);

}  // namespace firmtouch::log
