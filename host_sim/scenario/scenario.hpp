#pragma once
#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

#include "host_sim/plant/device.hpp"
#include "host_sim/plant/vec.hpp"

namespace firmtouch::host_sim {

/// What a reader must be told: file and line, what is wrong, how to mend it.
struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct HandModel {
  double stiffness_N_per_m = 400;  // a relaxed grip
  double damping_N_s_per_m = 4;
};

/// One line of the hand's script; they follow each other in time.
struct Move {
  enum class Kind { kHold, kMove, kPress, kFollow };
  Kind kind = Kind::kHold;
  Vec to_m;              // kMove, kPress
  double speed_mps = 0;  // kMove, kFollow
  double time_s = 0;     // kHold, kPress, kFollow
  // kFollow: how far behind the surface the hand aims; 0: it follows the guide itself.
  double press_m = 0;
};

/// Something that happens at a stated time, whatever the hand does.
struct Event {
  enum class Kind {
    kEmergencyStop,
    kDriveFault,
    kEncoderFault,
    kDisable,
    kEnable,
    kRelease,
    kClearFaults,
    kSet
  };
  double time_s = 0;
  Kind kind = Kind::kEnable;
  uint32_t parameter = 0;  // kSet: row of the parameter table
  double value = 0;        // SI
};

struct Setting {
  uint32_t parameter = 0;  // row of the parameter table
  double value = 0;        // SI
};

/// A row of the controller's parameter table, as the scenario's reader needs it.
struct ParameterRow {
  std::string name;
  std::string short_name;  // without its unit, "tool_radius" for "tool_radius_m": the unit stands
                           // beside the value
  std::string unit;        // SI; empty: a plain number
  double low = 0, high = 0, initial = 0;
};

struct Scenario {
  std::string file;   // where it was read from
  std::string text;   // as read, --set lines added: goes into the log
  std::string asset;  // path, made relative to the scenario's folder by the reader
  double rate_Hz = 1000;
  double geometry_rate_Hz = 0;  // 0: a local model in every tick
  double duration_s = 0;
  DeviceModel device;
  HandModel hand;
  bool has_start = false;
  Vec start_m;
  std::vector<Setting> settings;
  std::vector<Move> moves;
  std::vector<Event> events;  // in order of time
};

/// Reads a scenario: one statement a line, `#` after a blank begins a comment, every quantity carries its unit
/// (docs: scenario_help()). `sets` are further `key value unit` lines, from the command line. Throws Refused naming file and line for an unknown key,
/// statement or unit, a value out of range, a key given twice.
Scenario read_scenario(const std::string& file, const std::string& text,
                       const std::vector<std::string>& sets,
                       const std::vector<ParameterRow>& parameters);

/// All keys and statements with their units and defaults, for --help.
std::string scenario_help();

}  // namespace firmtouch::host_sim
