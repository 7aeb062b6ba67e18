#include "host_sim/scenario/scenario.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

#include "host_sim/hand/hands.hpp"
#include "host_sim/scenario/moves.hpp"

namespace firmtouch::host_sim {
namespace {

using tools::LineReader;

struct Key {
  const char* name;
  const char* unit;
  double low, high;
  double& (*member)(Scenario&);
  const char* meaning;
};

// The simulator's own keys. Every other key must be a row of the controller's parameter table.
const Key kKeys[] = {
    {"rate", "Hz", 50, 20000, [](Scenario& s) -> double& { return s.rate_Hz; },
     "servo ticks per second"},
    {"geometry_rate", "Hz", 1, 20000, [](Scenario& s) -> double& { return s.geometry_rate_Hz; },
     "local models per second; default: one in every tick"},
    {"duration", "s", 0.001, 3600, [](Scenario& s) -> double& { return s.duration_s; },
     "of the run; default: until the hand's script ends"},
    {"tick_jitter", "", 0, 0.9, [](Scenario& s) -> double& { return s.tick_jitter; },
     "share of a period by which a tick may be late, by chance"},
    {"seed", "", 0, 1e9, [](Scenario& s) -> double& { return s.seed; },
     "of jitter and of encoders' noise"},
    {"controller_clock", "Hz", 1e6, 1e11,
     [](Scenario& s) -> double& { return s.controller_clock_Hz; },
     "instructions a second: a tick's forces act as late as it takes; the\n"
     "                                    controller in this process counts none: the bound of "
     "tick_work"},
    {"mass", "kg", 1e-4, 100, [](Scenario& s) -> double& { return s.device.mass_kg; },
     "moving mass of the device at the tool"},
    {"viscous_friction", "N*s/m", 0, 1000,
     [](Scenario& s) -> double& { return s.device.viscous_N_s_per_m; }, "of each axis"},
    {"coulomb_friction", "N", 0, 100, [](Scenario& s) -> double& { return s.device.coulomb_N; },
     "of each axis"},
    {"encoder_quantum", "m", 1e-9, 0.01,
     [](Scenario& s) -> double& { return s.device.encoder_quantum_m; },
     "true metres per count; default: the controller's parameter"},
    {"motor_limit", "N", 0, 1000, [](Scenario& s) -> double& { return s.device.force_limit_N; },
     "largest force of each motor"},
    {"hand_stiffness", "N/m", 0, 100000,
     [](Scenario& s) -> double& { return s.hand.stiffness_N_per_m; }, "of the grip"},
    {"hand_damping", "N*s/m", 0, 1000,
     [](Scenario& s) -> double& { return s.hand.damping_N_s_per_m; }, "of the grip"},
    {"hand_mass", "kg", 0, 10, [](Scenario& s) -> double& { return s.hand.mass_kg; },
     "that the grip holds and the arm moves; 0: the grip follows the script"},
    {"hand_arm_stiffness", "N/m", 0, 100000,
     [](Scenario& s) -> double& { return s.hand.arm_stiffness_N_per_m; }, "of a hand with a mass"},
    {"hand_arm_damping", "N*s/m", 0, 1000,
     [](Scenario& s) -> double& { return s.hand.arm_damping_N_s_per_m; }, "of a hand with a mass"},
    {"hand_stiffening", "1/m", 0, 10000,
     [](Scenario& s) -> double& { return s.hand.stiffening_per_m; },
     "share by which the grip is stiffer a metre that it is stretched"},
    {"hand_tremor", "m", 0, 0.1, [](Scenario& s) -> double& { return s.hand.tremor_m; },
     "amplitude in each axis"},
    {"hand_tremor_frequency", "Hz", 0.1, 50,
     [](Scenario& s) -> double& { return s.hand.tremor_Hz; }, "people have 8 to 12 Hz"},
};
constexpr double kMinSubsteps = 16;         // of a tick, by Machine
constexpr double kMaxDelaySamples = 64;     // force feedback is impossible with more than 64 ms
constexpr double kMaxTurn_rad = 6.2831853;  // of a tool, as the controller allows

struct Reader {
  const std::vector<ParameterRow>& parameters;
  Scenario out{};
  std::vector<std::string> given{};

  void statement(LineReader& words);
  bool own_key(const std::string& name, LineReader& words);
  bool parameter(const std::string& name, LineReader& words);
  void event(LineReader& words);
  void hand(LineReader& words);
  void once(const std::string& name, LineReader& words);
};

// Budgets that counted visits: accepted in this version, with a note, and dropped in the next one.
struct FormerParameter {
  const char *name, *now;
  double factor;  // a visit takes two and a half units on average
};
constexpr FormerParameter kFormer[] = {{"mesh_steps", "mesh_work", 2.5},
                                       {"curve_steps", "guide_work", 2.5}};

uint32_t row_of(const std::vector<ParameterRow>& rows, const std::string& name) {
  for (uint32_t i = 0; i < rows.size(); ++i)
    if (rows[i].name == name || rows[i].short_name == name) return i;
  return UINT32_MAX;
}

// A row of the parameter table, by its name or a former one; UINT32_MAX: there is none.
struct NamedRow {
  uint32_t row = UINT32_MAX;
  const FormerParameter* former = nullptr;
};

NamedRow named_row(const std::vector<ParameterRow>& rows, const std::string& name) {
  for (const FormerParameter& former : kFormer) {
    if (name != former.name) continue;
    std::fprintf(stderr, "`%s` is now `%s`, in work units; a visit counts %g\n", former.name,
                 former.now, former.factor);
    return {row_of(rows, former.now), &former};
  }
  return {row_of(rows, name), nullptr};
}

double value_of(const std::vector<ParameterRow>& rows, const NamedRow& named, LineReader& words) {
  const ParameterRow& row = rows[named.row];
  const double value = words.quantity(row.short_name, row.unit, row.low, row.high);
  if (named.former == nullptr) return value;
  const double units = value * named.former->factor;
  if (!(units > row.high)) return units;
  std::fprintf(stderr, "`%s %g` is %g units: the largest `%s` is taken, %g\n", named.former->name,
               value, units, named.former->now, row.high);
  return row.high;
}

void Reader::once(const std::string& name, LineReader& words) {
  if (std::find(given.begin(), given.end(), name) != given.end() && !words.overrides())
    words.refuse("`" + name + "` is given twice; keep one of the two lines");
  given.push_back(name);
}

bool Reader::own_key(const std::string& name, LineReader& words) {
  for (const Key& key : kKeys) {
    if (name != key.name) continue;
    once(name, words);
    key.member(out) = words.quantity(name, key.unit, key.low, key.high);
    return true;
  }
  if (name != "output_delay") return false;
  once(name, words);
  const double samples = words.quantity(name, "samples", 0, kMaxDelaySamples);
  out.device.output_delay_samples = static_cast<uint32_t>(samples);
  out.device.output_delay_part = samples - std::floor(samples);
  return true;
}

bool Reader::parameter(const std::string& name, LineReader& words) {
  const NamedRow named = named_row(parameters, name);
  const uint32_t row = named.row;
  if (row == UINT32_MAX) return false;
  once(parameters[row].name, words);
  const double value = value_of(parameters, named, words);
  for (Setting& setting : out.settings)
    if (setting.parameter == row) return setting.value = value, true;
  out.settings.push_back({row, value});
  return true;
}

// at 9.5 s emergency_stop | drive_fault | encoder_fault | disable | enable | release |
// clear_faults | set KEY VALUE UNIT | load RATIO | move OBJECT SPEED | turn AXIS ANGLE UNIT |
// fail FAILURE JOINT
void Reader::event(LineReader& words) {
  struct Name {
    const char* name;
    Event::Kind kind;
  };
  constexpr Name kNames[] = {{"emergency_stop", Event::Kind::kEmergencyStop},
                             {"drive_fault", Event::Kind::kDriveFault},
                             {"encoder_fault", Event::Kind::kEncoderFault},
                             {"disable", Event::Kind::kDisable},
                             {"enable", Event::Kind::kEnable},
                             {"release", Event::Kind::kRelease},
                             {"clear_faults", Event::Kind::kClearFaults},
                             {"set", Event::Kind::kSet},
                             {"load", Event::Kind::kLoad},
                             {"move", Event::Kind::kMoveObject},
                             {"turn", Event::Kind::kTurnTool},
                             {"fail", Event::Kind::kFail}};
  Event event;
  event.time_s = words.quantity("at", "s", 0, 3600);
  const std::string what = words.next("an event");
  const Name* found = nullptr;
  for (const Name& name : kNames)
    if (what == name.name) found = &name;
  if (found == nullptr)
    words.refuse("unknown event `" + what +
                 "`; known: emergency_stop, drive_fault, encoder_fault, disable, enable, release, "
                 "clear_faults, set, load, move, turn, fail");
  event.kind = found->kind;
  if (event.kind == Event::Kind::kLoad) event.value = words.quantity("load", "", 0, 100);
  if (event.kind == Event::Kind::kMoveObject) {
    event.object = words.next("an object's name");
    event.value = words.quantity("move", "", -1, 1);
  }
  if (event.kind == Event::Kind::kFail) {
    const std::string name = words.next("a failure");
    if (!find_failure(name, event.failure.mode))
      words.refuse("unknown failure `" + name + "`; known: " + failure_names());
    const double joint = words.quantity("joint", "", 0, 2);
    if (joint > std::floor(joint)) words.refuse("a joint is 0, 1 or 2");
    event.failure.joint = static_cast<uint32_t>(joint);
  }
  if (event.kind == Event::Kind::kTurnTool) {
    const std::string axis = words.next("an axis");
    if (axis != "x" && axis != "y" && axis != "z")
      words.refuse("`turn " + axis + "`: an axis is x, y or z");
    event.parameter = static_cast<uint32_t>(axis[0] - 'x');
    event.value = words.quantity("turn", "rad", -kMaxTurn_rad, kMaxTurn_rad);
  }
  if (event.kind == Event::Kind::kSet) {
    const std::string name = words.next("a parameter's name");
    const NamedRow named = named_row(parameters, name);
    event.parameter = named.row;
    if (named.row == UINT32_MAX) words.refuse_unknown("parameter", name);
    event.value = value_of(parameters, named, words);
  }
  out.events.push_back(event);
}

// hand NAME weak|mean|firm: the five keys at once.
void Reader::hand(LineReader& words) {
  const std::string name = words.next("a hand"), grip = words.next("a grip");
  const HandModel* const found = find_hand(name, grip);
  if (found == nullptr)
    words.refuse("unknown hand `" + name + " " + grip + "`; hands are " + hand_names() +
                 ", each weak, mean or firm; firmtouch-sim hands lists them");
  for (const HandKey& key : hand_keys()) {
    once(key.name, words);
    out.hand.*key.member = found->*key.member;
  }
}

void Reader::statement(LineReader& words) {
  const std::string name = words.next("a statement");
  if (name == "asset") {
    once(name, words);
    out.asset = words.path();
  } else if (name == "device") {
    once(name, words);
    out.device_file = words.path();
  } else if (name == "hand_log") {
    once(name, words);
    out.hand_log = words.path();
  } else if (name == "mesh" || name == "guide") {
    once(name, words);
    (name == "mesh" ? out.scene.surface : out.scene.guide) = words.path();
  } else if (name == "start") {
    once(name, words);
    out.start_m = words.point("start");
    out.has_start = true;
  } else if (name == "hand") {
    hand(words);
  } else if (name == "at") {
    event(words);
  } else if (is_move(name)) {
    out.moves.push_back(read_move(name, words));
  } else if (!own_key(name, words) && !parameter(name, words)) {
    words.refuse_unknown("key or statement", name);
  }
  words.end();
}

// A linkage brings its own masses, encoders and motors.
void check_axes(const Reader& reader) {
  if (reader.out.device_file.empty()) return;
  for (const char* name :
       {"mass", "viscous_friction", "coulomb_friction", "encoder_quantum", "motor_limit"})
    if (std::find(reader.given.begin(), reader.given.end(), name) != reader.given.end())
      throw Refused(reader.out.file + ": `" + name + "` is of a device with straight axes; it " +
                    "stands in " + reader.out.device_file + " for its joints");
}

// The grip is a force that is constant during a substep.
void check_hand(const Scenario& scenario) {
  const HandModel& hand = scenario.hand;
  if (!scenario.hand_log.empty() && (!scenario.moves.empty() || scenario.has_start))
    throw Refused(scenario.file + ": `hand_log` brings its start and its way; leave out `start` " +
                  "and the hand's script");
  if (!scenario.hand_log.empty() && hand.stiffening_per_m > 0)
    throw Refused(scenario.file + ": `hand_stiffening` is of a hand without `hand_log`");
  if (!(hand.mass_kg > 0)) return;
  if (hand.stiffening_per_m > 0)
    throw Refused(scenario.file + ": `hand_stiffening` is of a hand without `hand_mass`");
  const double step_s = 1 / (kMinSubsteps * scenario.rate_Hz);
  if (!(hand.damping_N_s_per_m * step_s <= 0.2 * hand.mass_kg &&
        hand.stiffness_N_per_m * step_s * step_s <= 0.1 * hand.mass_kg))
    throw Refused(scenario.file + ": the grip is too stiff to simulate with so light a hand; " +
                  "raise `hand_mass` or `rate`, or lower `hand_damping`");
}

void check_whole(const Scenario& scenario) {
  if (scenario.asset.empty())
    throw Refused(scenario.file + ": it has no asset; add a line such as `asset part.fta`");
  if (scenario.moves.empty() && scenario.hand_log.empty() && !(scenario.duration_s > 0))
    throw Refused(scenario.file +
                  ": it has neither a `duration` nor a hand script, so no end; add one of them");
}

}  // namespace

Scenario read_scenario(const std::string& file, const std::string& text,
                       const std::vector<std::string>& sets,
                       const std::vector<ParameterRow>& parameters) {
  Reader reader{parameters};
  reader.out.file = file;
  reader.out.text = text;
  std::vector<std::string> names;
  for (const Key& key : kKeys) names.emplace_back(key.name);
  for (const char* name : {"output_delay", "asset", "device", "hand_log", "mesh", "guide", "start",
                           "at", "hand", "move", "hold", "press", "follow"})
    names.emplace_back(name);
  for (const ParameterRow& row : parameters) names.push_back(row.short_name);
  tools::read_lines(
      file, text, [&](LineReader& words, int) { reader.statement(words); }, names);
  for (const std::string& set : sets) {
    LineReader words(set, "--set " + set, names, true);
    if (words.empty()) words.refuse("nothing to set; write --set key=value");
    reader.statement(words);
    if (!reader.out.text.empty() && reader.out.text.back() != '\n') reader.out.text += '\n';
    reader.out.text += set + "\n";
  }
  check_whole(reader.out);
  check_axes(reader);
  check_hand(reader.out);
  std::stable_sort(reader.out.events.begin(), reader.out.events.end(),
                   [](const Event& a, const Event& b) { return a.time_s < b.time_s; });
  return reader.out;
}

std::string scenario_help() {
  std::ostringstream help;
  help << "A scenario is a text file with one statement a line. # begins a comment. Every quantity "
          "has a unit.\n\n"
          "  asset PATH                        baked asset, relative to the scenario's folder;\n"
          "                                    in \"quotes\" if it contains a # after a blank\n"
          "  mesh NAME                         mesh or spline surface to touch; default: the "
          "asset's\n"
          "                                    objects, or its first surface\n"
          "  device FILE                       linkage (firmtouch-sim device --help) that is "
          "simulated;\n"
          "                                    the asset was baked with --device FILE\n"
          "  hand_log FILE.ftl                 recorded run whose hand drives this one, without\n"
          "                                    `start` and script: the grip's target is where its\n"
          "                                    tool was, and further by force / stiffness\n"
          "  guide NAME                        curve to use as guide; default: the asset's first\n"
          "  start X Y Z m                     initial position of device and hand\n";
  Scenario defaults;
  for (const Key& key : kKeys) {
    std::string left = std::string("  ") + key.name + " VALUE " + key.unit;
    left.resize(std::max<size_t>(left.size() + 1, 36), ' ');
    help << left << key.meaning;
    const double value = key.member(defaults);
    if (value > 0) help << " (" << value << ")";
    help << "\n";
  }
  help << "  hand NAME weak|mean|firm          the five keys of a hand with a mass; NAME: "
       << hand_names() << "\n";
  help << "  output_delay VALUE samples        from the computed force to the motor's (0)\n"
          "  PARAMETER VALUE UNIT              any parameter of the controller, listed below\n\n"
          "The hand's script; the lines run one after the other:\n"
          "  move to X Y Z m at V m/s\n"
          "  hold for T s\n"
          "  press X Y Z m for T s             go there, stay for half the time, and return\n"
          "  startle X Y Z m                   jerk there within 0.1 s, and return in 0.4 s\n"
          "  let_go for T s                    no force; then the grip closes in 0.2 s\n"
          "  follow guide at V m/s for T s [pressing D m]\n"
          "                                    D: depth of the hand's aim below the surface\n\n"
          "Events, independent of the script:\n"
          "  at T s emergency_stop | drive_fault | disable | enable |\n"
          "         encoder_fault (of one sample: three in a row, or six of 32, are the fault) |\n"
          "         release (of emergency stop and drive fault) |\n"
          "         clear_faults (accepted only while disabled) | set PARAMETER VALUE UNIT |\n"
          "         load RATIO (from then on a tick with queries takes so many periods) |\n"
          "         move OBJECT SPEED (the asset's object moves by its twist times -1 to 1; 0: it "
          "stands)\n"
          "         turn x|y|z ANGLE deg (component of the rotation vector to which the tool's "
          "handle\n"
          "         turns, at most at 10 rad/s; of an asset with a tool)\n"
          "         fail FAILURE JOINT (of the machine, for the rest of the run; joints from 0)\n"
          "         FAILURE: " +
              failure_names() + "\n";
  return help.str();
}

}  // namespace firmtouch::host_sim
