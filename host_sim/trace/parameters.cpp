#include <sstream>

#include "firmtouch/params/table.hpp"
#include "host_sim/trace/run.hpp"

namespace firmtouch::host_sim {
namespace {

// A parameter's name without the unit that ends it.
std::string short_name(const std::string& name) {
  for (const char* suffix :
       {"_N_s_per_m", "_N_per_m", "_N_per_s", "_mps", "_Hz", "_J", "_N", "_s", "_m"}) {
    const std::string end = suffix;
    if (name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0)
      return name.substr(0, name.size() - end.size());
  }
  return name;
}

}  // namespace

std::vector<ParameterRow> parameter_rows() {
  std::vector<ParameterRow> rows;
  for (const params::Entry& entry : params::kTable) {
    const std::string unit = entry.unit;
    rows.push_back({entry.name, short_name(entry.name), unit == "1" ? "" : unit,
                    static_cast<double>(entry.low), static_cast<double>(entry.high),
                    static_cast<double>(entry.initial)});
  }
  return rows;
}

std::string parameter_help() {
  std::ostringstream help;
  help << "\nParameters of the controller: range (initial value): meaning\n";
  for (const params::Entry& entry : params::kTable) {
    const std::string unit = entry.unit;
    std::string left = "  " + short_name(entry.name) + " VALUE" + (unit == "1" ? "" : " " + unit);
    left.resize(std::max<size_t>(left.size() + 1, 36), ' ');
    help << left << entry.low << " to " << entry.high << " (" << entry.initial
         << "): " << entry.what << "\n";
  }
  return help.str();
}

}  // namespace firmtouch::host_sim
