#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "device/device_file.hpp"
#include "device/refused.hpp"
#include "host_sim/plant/device.hpp"
#include "host_sim/plant/failure.hpp"
#include "host_sim/plant/vec.hpp"

namespace firmtouch::host_sim {

using tools::Refused;

struct HandModel {
  double stiffness_N_per_m = 400;  // a relaxed grip
  double damping_N_s_per_m = 4;
  // Above 0: the grip holds a mass, and the arm moves it (hand/palm.hpp).
  double mass_kg = 0, arm_stiffness_N_per_m = 200, arm_damping_N_s_per_m = 4;
  // A grip stiffens with force: that of a stretch s is stiffness s (1 + stiffening s).
  double stiffening_per_m = 0;
  // Physiological tremor has 8 to 12 Hz (Elble & Koller 1990, Tremor). In each axis; their phases
  // differ by a third of a cycle.
  double tremor_m = 0, tremor_Hz = 10;
};

/// A recorded hand: where the tool was, and the force that the controller rendered there.
struct HandSample {
  double time_s = 0;  // from 0
  Vec at_m, force_N;
};

/// One line of the hand's script; the lines run one after the other.
struct Move {
  enum class Kind { kHold, kMove, kPress, kFollow, kLetGo, kStartle };
  Kind kind = Kind::kHold;
  Vec to_m;              // kMove, kPress, kStartle
  double speed_mps = 0;  // kMove, kFollow
  double time_s = 0;     // all but kMove
  // kFollow: depth of the hand's aim below the surface; 0: it follows the guide itself.
  double press_m = 0;
};

/// An event at a stated time, independent of the hand's script.
struct Event {
  enum class Kind {
    kEmergencyStop,
    kDriveFault,
    kEncoderFault,
    kDisable,
    kEnable,
    kRelease,
    kClearFaults,
    kSet,
    kLoad,
    kMoveObject,
    kTurnTool,
    kFail
  };
  double time_s = 0;
  Kind kind = Kind::kEnable;
  uint32_t parameter = 0;  // kSet: row of the parameter table; kTurnTool: axis
  // kSet: SI; kLoad: periods that a tick takes which queries the geometry; kMoveObject: times the
  // object's twist; kTurnTool: angle.
  double value = 0;
  std::string object = {};  // kMoveObject: its name
  Failure failure = {};     // kFail
};

struct Setting {
  uint32_t parameter = 0;  // row of the parameter table
  double value = 0;        // SI
};

/// The columns of the controller's parameter table that a scenario needs.
struct ParameterRow {
  std::string name;
  std::string short_name;  // without unit: "tool_radius" for "tool_radius_m"
  std::string unit;        // SI; empty: dimensionless
  double low = 0, high = 0, initial = 0;
};

/// Names of a surface (mesh or spline surface) and a guide of an asset; empty: the first one.
struct SceneNames {
  std::string surface, guide;
};

struct Scenario {
  std::string file;                             // path of the scenario
  std::string text;                             // as read, plus the --set lines; stored in logs
  std::string asset;                            // path, relative to the scenario's folder
  std::string device_file;                      // the same, of a linkage; empty: a Cartesian device
  std::optional<tools::LinkageDevice> linkage;  // read from there
  SceneNames scene;
  double rate_Hz = 1000;
  double geometry_rate_Hz = 0;  // 0: every tick makes a local model
  double duration_s = 0;
  double tick_jitter = 0;          // share of a period by which a tick may be late
  double seed = 1;                 // of jitter and of encoders' noise
  double controller_clock_Hz = 0;  // instructions a second; 0: a tick takes no time
  DeviceModel device;
  HandModel hand;
  std::string hand_log;              // path as `asset`; empty: the hand follows its script
  std::vector<HandSample> recorded;  // read from there
  bool has_start = false;
  Vec start_m;
  std::vector<Setting> settings;
  std::vector<Move> moves;
  std::vector<Event> events;  // in order of time
};

/// Parses a scenario: one statement a line, `#` after a blank begins a comment, every quantity has
/// a unit (syntax: scenario_help()). `sets`: further `key value unit` lines from the command line.
/// Throws Refused with file and line: unknown key, statement or unit, value out of range, key given
/// twice.
Scenario read_scenario(const std::string& file, const std::string& text,
                       const std::vector<std::string>& sets,
                       const std::vector<ParameterRow>& parameters);

/// All keys and statements with their units and defaults, for --help.
std::string scenario_help();

}  // namespace firmtouch::host_sim
