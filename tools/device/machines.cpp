#include "device/machines.hpp"

#include <fstream>
#include <sstream>

#include "device/refused.hpp"

namespace firmtouch::tools {
namespace {

struct Machine {
  const char *name, *text;
};

constexpr Machine kMachines[] = {
    {"haply_pantograph",
     R"(# Haply 2DIY, second generation. Links and base: hAPI (Pantograph: l, L, d).
# Encoder: its examples, 13,824 counts a turn.
linkage five_bar
base 0 mm
proximal_0 70 mm
proximal_1 70 mm
distal_0 90 mm
distal_1 90 mm
tip left
counts_0 13824 counts/turn
counts_1 13824 counts/turn
low_0 95 deg  # assumed
high_0 160 deg  # assumed
low_1 20 deg  # assumed
high_1 85 deg  # assumed
max_torque_0 0.35 N*m  # assumed
max_torque_1 0.35 N*m  # assumed
proximal_mass_0 20 g  # assumed
proximal_mass_1 20 g  # assumed
distal_mass_0 10 g  # assumed
distal_mass_1 10 g  # assumed
tip_mass 20 g  # assumed
rotor_0 5e-6 kg*m2  # assumed
rotor_1 5e-6 kg*m2  # assumed
viscous_0 1e-4 N*m*s/rad  # assumed
viscous_1 1e-4 N*m*s/rad  # assumed
)"},
    {"pantograph_mk2",
     R"(# Pantograph Mk-II. Links, base: Campion, Wang & Hayward 2005, The Pantograph Mk-II: A
# Haptic Instrument (IROS).
linkage five_bar
base 25 mm
proximal_0 63 mm
proximal_1 63 mm
distal_0 75 mm
distal_1 75 mm
tip left
counts_0 65536 counts/turn  # assumed
counts_1 65536 counts/turn  # assumed
low_0 95 deg  # assumed
high_0 155 deg  # assumed
low_1 25 deg  # assumed
high_1 85 deg  # assumed
max_torque_0 0.5 N*m  # assumed
max_torque_1 0.5 N*m  # assumed
proximal_mass_0 12 g  # assumed
proximal_mass_1 12 g  # assumed
distal_mass_0 8 g  # assumed
distal_mass_1 8 g  # assumed
tip_mass 10 g  # assumed
rotor_0 1e-6 kg*m2  # assumed
rotor_1 1e-6 kg*m2  # assumed
)"},
    {"falcon_like",
     R"(# A delta of about a Novint Falcon's size. Upper links, radii, encoder: libnifalcon,
# FalconGeometry.h (a; r, c, f - s; 320 slots, arm over shaft 110 / 14.25 mm). The Falcon's elbows
# have offsets that this delta lacks.
linkage delta
upper_0 60 mm
upper_1 60 mm
upper_2 60 mm
lower_0 125 mm  # assumed
lower_1 125 mm  # assumed
lower_2 125 mm  # assumed
base_radius 40 mm
platform_radius 14.43 mm
side 1.9 mm
tip above
counts_0 9881 counts/turn
counts_1 9881 counts/turn
counts_2 9881 counts/turn
low_0 0 deg  # assumed
low_1 0 deg  # assumed
low_2 0 deg  # assumed
high_0 70 deg  # assumed
high_1 70 deg  # assumed
high_2 70 deg  # assumed
max_torque_0 0.5 N*m  # assumed
max_torque_1 0.5 N*m  # assumed
max_torque_2 0.5 N*m  # assumed
upper_mass_0 30 g  # assumed
upper_mass_1 30 g  # assumed
upper_mass_2 30 g  # assumed
lower_mass_0 10 g  # assumed
lower_mass_1 10 g  # assumed
lower_mass_2 10 g  # assumed
tip_mass 80 g  # assumed
rotor_0 3e-5 kg*m2  # assumed
rotor_1 3e-5 kg*m2  # assumed
rotor_2 3e-5 kg*m2  # assumed
carried_share 0.5  # assumed
)"},
    {"omega_like", R"(# A delta for a workspace of about 160 mm. No value has a source.
linkage delta
upper_0 100 mm  # assumed
upper_1 100 mm  # assumed
upper_2 100 mm  # assumed
lower_0 180 mm  # assumed
lower_1 180 mm  # assumed
lower_2 180 mm  # assumed
base_radius 60 mm  # assumed
platform_radius 25 mm  # assumed
tip above  # assumed
counts_0 40000 counts/turn  # assumed
counts_1 40000 counts/turn  # assumed
counts_2 40000 counts/turn  # assumed
low_0 0 deg  # assumed
low_1 0 deg  # assumed
low_2 0 deg  # assumed
high_0 70 deg  # assumed
high_1 70 deg  # assumed
high_2 70 deg  # assumed
max_torque_0 1.2 N*m  # assumed
max_torque_1 1.2 N*m  # assumed
max_torque_2 1.2 N*m  # assumed
upper_mass_0 60 g  # assumed
upper_mass_1 60 g  # assumed
upper_mass_2 60 g  # assumed
lower_mass_0 20 g  # assumed
lower_mass_1 20 g  # assumed
lower_mass_2 20 g  # assumed
tip_mass 100 g  # assumed
rotor_0 1e-4 kg*m2  # assumed
rotor_1 1e-4 kg*m2  # assumed
rotor_2 1e-4 kg*m2  # assumed
carried_share 0.5  # assumed
)"},
    {"phantom_premium_15",
     R"(# Phantom Premium 1.5. Links, parallelogram: Cavusoglu, Feygin & Tendick 2002, A
# Critical Study of the Mechanical and Electrical Properties of the PHANToM Haptic Interface.
linkage serial_arm 3
link_0 215 mm
link_1 170 mm
elbow parallelogram
counts_0 30000 counts/turn  # assumed
counts_1 30000 counts/turn  # assumed
counts_2 30000 counts/turn  # assumed
low_0 -60 deg  # assumed
high_0 60 deg  # assumed
low_1 0 deg  # assumed
high_1 65 deg  # assumed
low_2 -95 deg  # assumed
high_2 -25 deg  # assumed
max_torque_0 1.8 N*m  # assumed
max_torque_1 1.8 N*m  # assumed
max_torque_2 1.8 N*m  # assumed
link_mass_0 60 g  # assumed
link_mass_1 40 g  # assumed
tip_mass 30 g  # assumed
rotor_0 5e-4 kg*m2  # assumed
rotor_1 5e-4 kg*m2  # assumed
rotor_2 5e-4 kg*m2  # assumed
carried_share 0.5  # assumed
)"},
    {"touch_like", R"(# An arm of about the size of a Touch. No value has a source.
linkage serial_arm 3
link_0 133 mm  # assumed
link_1 133 mm  # assumed
elbow relative  # assumed
counts_0 16000 counts/turn  # assumed
counts_1 16000 counts/turn  # assumed
counts_2 16000 counts/turn  # assumed
low_0 -55 deg  # assumed
high_0 55 deg  # assumed
low_1 10 deg  # assumed
high_1 100 deg  # assumed
low_2 -140 deg  # assumed
high_2 -30 deg  # assumed
max_torque_0 0.6 N*m  # assumed
max_torque_1 0.6 N*m  # assumed
max_torque_2 0.6 N*m  # assumed
link_mass_0 40 g  # assumed
link_mass_1 25 g  # assumed
tip_mass 30 g  # assumed
rotor_0 1e-4 kg*m2  # assumed
rotor_1 1e-4 kg*m2  # assumed
rotor_2 1e-4 kg*m2  # assumed
carried_share 0.5  # assumed
)"}};

}  // namespace

std::vector<std::string> machine_names() {
  std::vector<std::string> names;
  for (const Machine& machine : kMachines) names.emplace_back(machine.name);
  return names;
}

std::string machine_text(const std::string& name) {
  for (const Machine& machine : kMachines)
    if (name == machine.name) return machine.text;
  return "";
}

std::vector<std::string> assumed_keys(const std::string& text) {
  std::vector<std::string> keys;
  std::istringstream lines(text);
  const std::string mark = "# assumed";
  for (std::string line; std::getline(lines, line);)
    if (line.size() > mark.size() &&
        line.compare(line.size() - mark.size(), mark.size(), mark) == 0)
      keys.push_back(line.substr(0, line.find(' ')));
  return keys;
}

std::string read_device_text(const std::string& name) {
  std::string text = machine_text(name);
  if (!text.empty()) return text;
  std::ifstream file(name, std::ios::binary);
  std::ostringstream read;
  if (file && file.peek() != std::ifstream::traits_type::eof()) read << file.rdbuf();
  if (!file.is_open() || file.bad()) {  // a folder is bad
    std::string names;
    for (const std::string& known : machine_names()) names += (names.empty() ? "" : ", ") + known;
    throw Refused(name + ": it cannot be read, and is no machine; machines are " + names);
  }
  return read.str();
}

}  // namespace firmtouch::tools
