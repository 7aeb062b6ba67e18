#include "device/units.hpp"

namespace firmtouch::tools {
namespace {

struct Unit {
  const char* name;
  const char* dimension;
  double si;
};

// Damping is printed as N*s/m; the other spellings are accepted. A name with a blank occurs in the
// parameter table only; a scenario cannot contain it.
constexpr Unit kUnits[] = {
    {"m", "length", 1},
    {"mm", "length", 1e-3},
    {"um", "length", 1e-6},
    {"cm", "length", 1e-2},
    {"in", "length", 0.0254},
    {"s", "time", 1},
    {"ms", "time", 1e-3},
    {"us", "time", 1e-6},
    {"kg", "mass", 1},
    {"g", "mass", 1e-3},
    {"N", "force", 1},
    {"mN", "force", 1e-3},
    {"J", "energy", 1},
    {"mJ", "energy", 1e-3},
    {"m/s", "speed", 1},
    {"mm/s", "speed", 1e-3},
    {"N/m", "stiffness", 1},
    {"N/mm", "stiffness", 1e3},
    {"N*s/m", "damping", 1},
    {"N.s/m", "damping", 1},
    {"Ns/m", "damping", 1},
    {"N/s", "force rate", 1},
    {"N/ms", "force rate", 1e3},
    {"Hz", "frequency", 1},
    {"kHz", "frequency", 1e3},
    {"MHz", "frequency", 1e6},
    {"GHz", "frequency", 1e9},
    {"samples", "samples", 1},
    {"ticks", "samples", 1},
    {"m/s2", "acceleration", 1},
    {"m/s^2", "acceleration", 1},
    {"rad", "angle", 1},
    {"deg", "angle", 0.017453292519943295},
    {"rad/s", "angular speed", 1},
    {"deg/s", "angular speed", 0.017453292519943295},
    {"kg*m2", "inertia", 1},
    {"g*cm2", "inertia", 1e-7},
    {"N*m*s/rad", "angular damping", 1},
    {"mN*m*s/rad", "angular damping", 1e-3},
    {"N*m/rad", "angular stiffness", 1},
    {"mN*m/rad", "angular stiffness", 1e-3},
    {"N*m", "torque", 1},
    {"N.m", "torque", 1},
    {"mN*m", "torque", 1e-3},
    {"K", "temperature rise", 1},
    {"A", "current", 1},
    {"mA", "current", 1e-3},
    {"N*m/A", "torque constant", 1},
    {"mN*m/A", "torque constant", 1e-3},
    {"counts/rad", "counts per angle", 1},
    {"counts/turn", "counts per angle", 0.15915494309189535},
    {"steps", "steps", 1},
    {"visits", "steps", 1},
    {"1/m", "count density", 1},
    {"counts/m", "count density", 1},
    {"counts/mm", "count density", 1e3},
    {"N s/m", "damping", 1},
};

const Unit* find(const std::string& name) {
  for (const Unit& unit : kUnits)
    if (name == unit.name) return &unit;
  return nullptr;
}

}  // namespace

std::optional<double> to_si(double value, const std::string& unit, const std::string& wanted) {
  if (unit == wanted) {
    const Unit* known = find(unit);
    return value * (known == nullptr ? 1 : known->si);
  }
  const Unit* from = find(unit);
  const Unit* to = find(wanted);
  if (from == nullptr || to == nullptr || std::string(from->dimension) != to->dimension) return {};
  return value * from->si;
}

std::string units_like(const std::string& wanted) {
  const Unit* like = find(wanted);
  if (like == nullptr) return wanted.empty() ? "no unit" : wanted;
  std::string list;
  for (const Unit& unit : kUnits) {
    const std::string name = unit.name;
    if (std::string(unit.dimension) != like->dimension || name.find(' ') != std::string::npos)
      continue;
    list += (list.empty() ? "" : ", ") + name;
  }
  return list;
}

}  // namespace firmtouch::tools
