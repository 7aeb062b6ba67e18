#include "device/machines.hpp"

#include <fstream>
#include <sstream>

#include "device/refused.hpp"

namespace firmtouch::tools {
namespace {

// A line whose key ends with `*` stands for one a joint.
struct Machine {
  const char* name;
  char joints;
  const char* text;
};

constexpr Machine kMachines[] = {
    {"haply_pantograph", 2,
     R"(# Haply 2DIY, second generation. Links and base: hAPI (Pantograph: l, L, d).
# Encoder: its examples, 13,824 counts a turn.
linkage five_bar
base 0 mm
proximal_* 70 mm
distal_* 90 mm
tip left
counts_* 13824 counts/turn
low_0 95 deg  # assumed
high_0 160 deg  # assumed
low_1 20 deg  # assumed
high_1 85 deg  # assumed
max_torque_* 0.35 N*m  # assumed
proximal_mass_* 20 g  # assumed
distal_mass_* 10 g  # assumed
tip_mass 20 g  # assumed
rotor_* 5e-6 kg*m2  # assumed
viscous_* 1e-4 N*m*s/rad  # assumed
)"},
    {"pantograph_mk2", 2,
     R"(# Pantograph Mk-II. Links, base: Campion, Wang & Hayward 2005, The Pantograph Mk-II: A
# Haptic Instrument (IROS).
linkage five_bar
base 25 mm
proximal_* 63 mm
distal_* 75 mm
tip left
counts_* 65536 counts/turn  # assumed
low_0 95 deg  # assumed
high_0 155 deg  # assumed
low_1 25 deg  # assumed
high_1 85 deg  # assumed
max_torque_* 0.5 N*m  # assumed
proximal_mass_* 12 g  # assumed
distal_mass_* 8 g  # assumed
tip_mass 10 g  # assumed
rotor_* 1e-6 kg*m2  # assumed
)"},
    {"falcon_like", 3,
     R"(# A delta of about a Novint Falcon's size. Upper links, radii, encoder: libnifalcon,
# FalconGeometry.h (a; r, c, f - s; 320 slots, arm over shaft 110 / 14.25 mm). The Falcon's elbows
# have offsets that this delta lacks.
linkage delta
upper_* 60 mm
lower_* 125 mm  # assumed
base_radius 40 mm
platform_radius 14.43 mm
side 1.9 mm
tip above
counts_* 9881 counts/turn
low_* 0 deg  # assumed
high_* 70 deg  # assumed
max_torque_* 0.5 N*m  # assumed
upper_mass_* 30 g  # assumed
lower_mass_* 10 g  # assumed
tip_mass 80 g  # assumed
rotor_* 3e-5 kg*m2  # assumed
carried_share 0.5  # assumed
)"},
    {"omega_like", 3, R"(# A delta for a workspace of about 160 mm. No value has a source.
linkage delta
upper_* 100 mm  # assumed
lower_* 180 mm  # assumed
base_radius 60 mm  # assumed
platform_radius 25 mm  # assumed
tip above  # assumed
counts_* 40000 counts/turn  # assumed
low_* 0 deg  # assumed
high_* 70 deg  # assumed
max_torque_* 1.2 N*m  # assumed
upper_mass_* 60 g  # assumed
lower_mass_* 20 g  # assumed
tip_mass 100 g  # assumed
rotor_* 1e-4 kg*m2  # assumed
carried_share 0.5  # assumed
)"},
    {"phantom_premium_15", 3,
     R"(# Phantom Premium 1.5. Links, parallelogram: Cavusoglu, Feygin & Tendick 2002, A
# Critical Study of the Mechanical and Electrical Properties of the PHANToM Haptic Interface.
linkage serial_arm 3
link_0 215 mm
link_1 170 mm
elbow parallelogram
counts_* 30000 counts/turn  # assumed
low_0 -60 deg  # assumed
high_0 60 deg  # assumed
low_1 0 deg  # assumed
high_1 65 deg  # assumed
low_2 -95 deg  # assumed
high_2 -25 deg  # assumed
max_torque_* 1.8 N*m  # assumed
link_mass_0 60 g  # assumed
link_mass_1 40 g  # assumed
tip_mass 30 g  # assumed
rotor_* 5e-4 kg*m2  # assumed
carried_share 0.5  # assumed
)"},
    {"touch_like", 3, R"(# An arm of about the size of a Touch. No value has a source.
linkage serial_arm 3
link_0 133 mm  # assumed
link_1 133 mm  # assumed
elbow relative  # assumed
counts_* 16000 counts/turn  # assumed
low_0 -55 deg  # assumed
high_0 55 deg  # assumed
low_1 10 deg  # assumed
high_1 100 deg  # assumed
low_2 -140 deg  # assumed
high_2 -30 deg  # assumed
max_torque_* 0.6 N*m  # assumed
link_mass_0 40 g  # assumed
link_mass_1 25 g  # assumed
tip_mass 30 g  # assumed
rotor_* 1e-4 kg*m2  # assumed
carried_share 0.5  # assumed
)"}};

}  // namespace

std::vector<std::string> machine_names() {
  std::vector<std::string> names;
  for (const Machine& machine : kMachines) names.emplace_back(machine.name);
  return names;
}

std::string machine_text(const std::string& name) {
  std::string text;
  for (const Machine& machine : kMachines) {
    if (name != machine.name) continue;
    std::istringstream lines(machine.text);
    for (std::string line; std::getline(lines, line);) {
      const size_t joint = line.find("_*") + 1;  // 0: none
      for (char k = 0; k < (joint == 0 ? 1 : machine.joints); ++k) {
        if (joint != 0) line[joint] = static_cast<char>('0' + k);
        text += line + "\n";
      }
    }
  }
  return text;
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
